// Sources of feltgate_core in order, relative to rtl/; the design's feltgate_pkg.sv comes first.
mult.sv
lowpass.sv
sequencer.sv
registers.sv
quad_decoder.sv
velocity_n.sv
dob.sv
scene_setpoint.sv
scene_membrane.sv
scene_spring.sv
scene_damper.sv
scene_charge.sv
scenes.sv
torque_control.sv
supervisor.sv
pwm.sv
feltgate_core.sv
