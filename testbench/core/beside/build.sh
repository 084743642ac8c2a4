set -e; D=$1; cd $HERE; mkdir -p $D; G=${G:-$OLD/rtl}; python3 make_cfg.py $G $D $D
O=""; for f in $(grep -v '^//' $OLD/rtl/feltgate_core.f | grep .); do O="$O $OLD/rtl/$f"; done
[ -f $D/o/Vold_wrap__ALL.a ] || { verilator --cc --build -j 2 -O3 -CFLAGS -O1 --top-module old_wrap -Wno-fatal -Wno-lint --Mdir $D/o $G/generated/$D/feltgate_pkg.sv $O old_wrap.sv > $D/o.log 2>&1; }
rm -rf $D/n; verilator --cc --build -j 2 -O3 -CFLAGS -O1 --top-module new_wrap -Wno-fatal -Wno-lint --Mdir $D/n $D/cfg.sv $D/map.sv $(bash files.sh) new_wrap.sv > $D/n.log 2>&1 || { grep Error $D/n.log; exit 1; }
g++ -O1 -std=c++17 -I/usr/share/verilator/include -I$D/o -I$D/n cosim.cpp $D/o/Vold_wrap__ALL.a $D/n/Vnew_wrap__ALL.a /usr/share/verilator/include/verilated.cpp /usr/share/verilator/include/verilated_threads.cpp -o $D/cosim -pthread 2>&1 | grep -E "error|undefined" | head
