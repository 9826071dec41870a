set terminal pngcairo size 900,600 font 'DejaVu Sans,11'
set output 'fig-5-9.png'
set grid lc rgb '#dddddd'
set title 'Vibration signal, cancellous bone, 1 kHz (fig. 5.9)'
set xlabel 'time, s'
set ylabel 'acceleration, g'
set yrange [-4:4]
plot 'fig-5-9.dat' using 1:2 with lines lw 0.6 notitle
