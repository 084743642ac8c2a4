// Beside it where FELTGATE_ECP5 is defined; paths are relative to this folder.
// sources: written by scripts/check_blocks.py --write
core/wave/mult18_ecp5.sv
