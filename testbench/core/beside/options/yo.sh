D=$1; cd $HERE; W=/tmp/yo_$D; mkdir -p $W; cp $D/cfg.sv $D/map.sv $(bash files.sh $D) $W/; cd $W; L="cfg.sv map.sv fx.sv"; for f in $(bash $HERE/files.sh $D); do b=$(basename $f); [ $b = fx.sv ] || L="$L $b"; done
nice -n 15 timeout 200 yosys -q -p "read_verilog -sv $L; hierarchy -check -top ${D}_top; $2" 2>&1 | grep -v "Warning: wire\|Replacing memory" | tail -12; echo yosys $D done
