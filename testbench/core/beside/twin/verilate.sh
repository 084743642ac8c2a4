cd $HERE; D=$1
rm -rf $D/v; verilator --cc --build -j 1 -O3 -CFLAGS -O1 --top-module lever_wrap -Wno-fatal -Wno-lint --prefix Vtop --Mdir $D/v $D/cfg.sv $D/map.sv $(bash files.sh) $NEW/testbench/core/axis/lever_wrap.sv > $D/v.log 2>&1 || grep Error $D/v.log
