set terminal pngcairo size 900,600 font 'DejaVu Sans,11'
set output 'fig-5-7.png'
set grid lc rgb '#dddddd'
set title 'Periodogram, cancellous bone, five stretches of 12 s (fig. 5.7)'
set xlabel 'frequency, Hz'
set ylabel 'power, dB (g^2/Hz)'
set key bottom right
plot for [i=2:6] 'fig-5-7.dat' using 1:i with lines lw 0.8 title sprintf('stretch %d', i - 1)
