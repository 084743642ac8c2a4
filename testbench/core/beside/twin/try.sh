cd $HERE; AXIS_DESIGN=$1/design.txt AXIS_TICKS=$2 AXIS_SEED=${3:-1} timeout 560 nice -n 15 ./$1/${NAME:-axis_test} $4 | head -40
