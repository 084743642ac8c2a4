verilator --lint-only -Wall -Wno-DECLFILENAME -Wno-UNUSEDSIGNAL -Wno-UNUSEDPARAM $1/cfg.sv $1/map.sv $(bash files.sh) --top-module lever_top 2>&1
