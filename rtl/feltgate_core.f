// The core; a design's feltgate_pkg.sv comes first; paths are relative to this folder.
// sources: written by scripts/check_blocks.py --write
generated/feltgate_map_pkg.sv
feltgate_checks.sv
sequencer.sv
registers.sv
quad_decoder.sv
lowpass.sv
velocity_n.sv
dob.sv
scene_setpoint.sv
scene_membrane.sv
scene_spring.sv
scene_damper.sv
scene_charge.sv
scene_wall.sv
scenes.sv
torque_control.sv
supervisor.sv
pwm.sv
mult.sv
feltgate_core.sv
