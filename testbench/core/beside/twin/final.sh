cd $HERE
OPT=-O1 NAME=axis_test3 bash build.sh lever; echo built $(date +%T)
NAME=axis_test3 bash try.sh lever 8000 31
mut() { # name file from to
  rm -rf mut; mkdir mut; cp -r $NEW/model mut/; sed -i "s#$3#$4#" mut/model/include/feltgate/axis/$2; diff -rq mut/model/include/feltgate/axis $NEW/model/include/feltgate/axis >/dev/null && echo "mutant $1 is no change";
  V=/usr/share/verilator/include; D=lever
  nice -n 15 g++ -O1 -std=c++17 -Imut/model/include -isystem shim -isystem $V -isystem $D/v $NEW/testbench/core/axis/axis_test.cpp $D/v/Vtop__ALL.a verilated.o threads.o -o $D/axis_mut -pthread
  echo "mutant $1:"; NAME=axis_mut bash try.sh lever 8000 31; date +%T; }
mut "voltage a clock late" torque_law.hpp "a.at(5)" "a.at(6)"
mut "duty a clock early in a whole tick" lever_top.hpp "run(before, duty_clock)" "run(before, duty_clock - 1)"
mut "frozen ramp may grow by 0" ramp.hpp "target > 0" "target >= 0"
mut "heat borne while disarmed" motor_heat.hpp "armed \&\& sum" "sum"
