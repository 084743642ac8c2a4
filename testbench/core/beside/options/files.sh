R=$NEW/rtl; T=$1
O=""
case $T in
lever) O="";;
lever_absolute) O="absolute absolute_encoder serial_frame";;
lever_current) O="h_bridge_current current_sensors current_sense overcurrent current_command current_control current_check serial_multiplier heartbeat";;
hall_motor) O="quadrature_hall hall_sensor three_phase commutation electrical_angle space_vector serial_multiplier pwm_three_phase";;
gimbal_motor) O="absolute absolute_encoder serial_frame three_phase commutation electrical_angle space_vector serial_multiplier pwm_three_phase";;
gimbal_current) O="absolute absolute_encoder serial_frame three_phase_current current_sensors current_sense overcurrent current_command current_check serial_multiplier electrical_angle heartbeat field_oriented cordic open_phase space_vector pwm_three_phase";;
esac
for o in $O; do [ -f $R/options/$o.sv ] && L="$L $R/options/$o.sv"; done
echo $R/core/fx.sv $R/core/{tick_counter,travel_window,velocity_estimator,observer,divider,scene,ramp,torque_law,quadrature,h_bridge,axis}.sv $R/core/encoder/{quad_decoder,encoder_monitor}.sv $R/core/actuation/pwm.sv $R/safety/*.sv $R/host/*.sv $L $R/tops/${T}_top.sv
