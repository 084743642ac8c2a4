cd $HERE; mkdir -p lever; python3 make_cfg.py $OLD/rtl lever lever
verilator --cc --build -j 1 -O3 -CFLAGS -O0 --top-module new_wrap -Wno-fatal -Wno-lint -MAKEFLAGS VM_PARALLEL_BUILDS=0 --Mdir lever/n lever/cfg.sv lever/map.sv $(bash files.sh lever) $HERE/new_wrap.sv > lever/n.log 2>&1
g++ -O1 -std=c++17 -I/usr/share/verilator/include -I$HERE/lever/o -Ilever/n $HERE/cosim.cpp $HERE/lever/o/Vold_wrap__ALL.a lever/n/Vnew_wrap__ALL.a verilated.o verilated_threads.o -o lever/cosim -pthread
