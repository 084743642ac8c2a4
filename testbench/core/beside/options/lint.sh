cd $HERE; verilator --lint-only -Wall -Wno-DECLFILENAME -Wno-UNUSEDSIGNAL -Wno-UNUSEDPARAM $1/cfg.sv $1/map.sv $(bash files.sh $1) --top-module $1_top 2>&1
