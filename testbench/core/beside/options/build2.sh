set -e; D=$1; V=${2:-d}; cd $HERE; mkdir -p $D; G=$OLD/rtl; python3 make_cfg.py $G $D $D
O=""; for f in $(grep -v '^//' $OLD/rtl/feltgate_core.f | grep .); do O="$O $OLD/rtl/$f"; done
case $D in lever_absolute) F="-DABS"; K="-DABS=1";; lever_current) F="-DCUR=1"; K="-DCUR=1";; hall_motor) F="-DHALL -DTHREE"; K="-DHALL=1 -DTHREE=1";; gimbal_motor) F="-DABS -DTHREE"; K="-DABS=2 -DTHREE=1";; gimbal_current) F="-DABS -DTHREE -DCUR=2"; K="-DABS=2 -DTHREE=1 -DCUR=2";; esac
[ -f $D/o/Vold_wrap__ALL.a ] || { verilator --cc --build -j 1 -O3 -CFLAGS -O1 --top-module old_wrap -Wno-fatal -Wno-lint --Mdir $D/o $G/generated/$D/feltgate_pkg.sv $O old_wrap.sv > $D/o.log 2>&1; }
N=$(bash files.sh $D)
if [ $V != p ]; then sed -e 's/\.drive_i(drive)/.drive_i(late)/;s/^  cfg::drive_t drive;/  cfg::drive_t drive, late; drive_delay u_drive_delay (.clk_i(clk_i), .rst_ni(rst_ni), .drive_i(drive), .drive_o(late));/' $NEW/rtl/tops/${D}_top.sv > $D/top.sv; N="${N% *} drive_delay.sv $D/top.sv"; fi
rm -rf $D/n$V; verilator --cc --build -j 1 -O3 -CFLAGS -O0 --top-module new_wrap -DTOP=${D}_top $F -Wno-fatal -Wno-lint -MAKEFLAGS VM_PARALLEL_BUILDS=0 --Mdir $D/n$V $D/cfg.sv $D/map.sv $N new_wrap.sv > $D/n.log 2>&1 || { grep -A3 Error $D/n.log | head -40; exit 1; }
g++ -O1 -std=c++17 $K -I/usr/share/verilator/include -I$D/o -I$D/n$V cosim.cpp $D/o/Vold_wrap__ALL.a $D/n$V/Vnew_wrap__ALL.a verilated.o verilated_threads.o -DSPEED=${SPEED:-200} -o $D/cosim_$V -pthread 2>&1 | grep -E "error|undefined" | head
