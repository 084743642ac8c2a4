R=$NEW/rtl
echo $R/core/fx.sv $R/core/{tick_counter,travel_window,velocity_estimator,observer,divider,scene,ramp,torque_law,quadrature,h_bridge,axis}.sv $R/core/encoder/{quad_decoder,encoder_monitor}.sv $R/core/actuation/pwm.sv $R/safety/*.sv $R/host/*.sv $R/tops/lever_top.sv
