cd $HERE
while pgrep -f "build.sh hall_motor d; bash" > /dev/null; do sleep 3; done
bash build2.sh gimbal_current e; bash build2.sh lever_current e
D=hall_motor; g++ -O1 -std=c++17 -DHALL=1 -DTHREE=1 -DSPEED=200 -I/usr/share/verilator/include -I$D/o -I$D/nd cosim.cpp $D/o/Vold_wrap__ALL.a $D/nd/Vnew_wrap__ALL.a verilated.o verilated_threads.o -o $D/cosim_d2 -pthread
bash build2.sh lever_current p
