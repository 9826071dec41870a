set terminal pngcairo size 900,600 font 'DejaVu Sans,11'
set output 'fig-5-4.png'
set grid lc rgb '#dddddd'
set title 'Feed rate and density, cortical bone, 52 N (fig. 5.4)'
set xlabel 'density, g/cc'
set ylabel 'feed rate, mm/s'
set offsets graph 0.1, graph 0.1, graph 0.15, graph 0.15
theirs(x) = -0.05 * x + 0.11
ours(x) = -0.0489726 * x + 0.105697
plot 'fig-5-4.dat' using 1:2 with points pt 6 ps 1.8 lc rgb '#1f77b4' title 'thesis, table 5.1', 'fig-5-4.dat' using 1:3 with points pt 7 ps 0.9 lc rgb '#d62728' title 'ours, specimen factors', theirs(x) with lines lw 2 lc rgb '#1f77b4' title 'thesis, eq. 5.1', ours(x) with lines lw 2 dt 2 lc rgb '#d62728' title 'ours, regression'
