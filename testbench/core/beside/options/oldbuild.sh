cd $HERE
for D in lever_current hall_motor gimbal_motor gimbal_current; do G=$OLD/rtl; mkdir -p $D
O=""; for f in $(grep -v '^//' $OLD/rtl/feltgate_core.f | grep .); do O="$O $OLD/rtl/$f"; done
[ -f $D/o/Vold_wrap__ALL.a ] || verilator --cc --build -j 1 -O3 -CFLAGS -O1 --top-module old_wrap -Wno-fatal -Wno-lint --Mdir $D/o $G/generated/$D/feltgate_pkg.sv $O old_wrap.sv > $D/o.log 2>&1
done
