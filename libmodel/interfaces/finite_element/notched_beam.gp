# Load against opening of the notch and against deflection, beside the straight cohesive crack of data/reference:
#   for h in 0.008 0.004 0.002; do build/release/bin/fpz-fe-beam $h beam_$h.csv; done
#   gnuplot libmodel/interfaces/finite_element/notched_beam.gp     writes docs/images/finite-element-beam.png
set terminal pngcairo size 1100,480 font "sans,11"
set output "docs/images/finite-element-beam.png"
set datafile separator ","
set datafile commentschars "#"
set key top right
set grid
set ylabel "load, kN"
set yrange [0:2.8]
reference = "data/reference/beam_3pb_rollers_8mm.csv"
set multiplot layout 1,2
do for [c = 2:3] {
  set xlabel (c == 2 ? "opening of the notch, um" : "deflection at half depth, um")
  last = (c == 2 ? 60 : 70)
  set xrange [0:last]
  plot reference using (column(c)*1e6):($1*1e-3) with lines lw 3 lc rgb "#999999" title "straight crack", \
       "beam_0.008.csv" using (column(c)*1e6):($1*1e-3) with lines lw 1.5 title "triangles of 8 mm", \
       "beam_0.004.csv" using (column(c)*1e6):($1*1e-3) with lines lw 1.5 title "4 mm", \
       "beam_0.002.csv" using (column(c)*1e6):($1*1e-3) with lines lw 1.5 title "2 mm"
}
