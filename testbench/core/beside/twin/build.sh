# build.sh DESIGN: builds the test program
cd $NEW; D=$HERE/$1; V=/usr/share/verilator/include
nice -n 15 g++ ${OPT:--O1} -std=c++17 -Wall -Wextra -Wconversion -Wpedantic -Imodel/include ${SHIM:--isystem $HERE/shim} -isystem $V -isystem $D/v testbench/core/axis/axis_test.cpp $D/v/Vtop__ALL.a $HERE/verilated.o $HERE/threads.o -o $D/${NAME:-axis_test} -pthread
