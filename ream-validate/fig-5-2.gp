set terminal pngcairo size 900,600 font 'DejaVu Sans,11'
set output 'fig-5-2.png'
set grid lc rgb '#dddddd'
set title 'Thrust and displacement, cortical bone, mean and deviation of six (fig. 5.2)'
set xlabel 'time since contact, s'
set ylabel 'thrust, N'
set y2label 'displacement, mm'
set ytics nomirror
set y2tics
set yrange [0:80]
set y2range [0:*]
set key top left
set style fill transparent solid 0.2 noborder
set datafile missing 'nan'
f = 'fig-5-2.dat'
b = '#1f77b4'
r = '#d62728'
d = 4.26
plot f using 1:($6-d):($6+d) with filledcurves lc rgb b title 'thesis, held thrust, deviation', f using 1:6 with lines lw 2 dt 2 lc rgb b title 'thesis, held thrust', f using 1:($2-$3):($2+$3) with filledcurves lc rgb b notitle, f using 1:2 with lines lw 2 lc rgb b title 'ours, thrust', f using 1:($4-$5):($4+$5) axes x1y2 with filledcurves lc rgb r title 'ours, displacement, deviation', f using 1:4 axes x1y2 with lines lw 2 lc rgb r title 'ours, displacement', f using 1:7 axes x1y2 with lines lw 2 dt 2 lc rgb r title 'at the feed of the thesis'
