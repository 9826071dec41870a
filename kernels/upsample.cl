#include "common.h"
#include "layout.h"

// Trilinear upsampling, exact in unsigned 32-bit integers. Twin of server/voxel/upsample.cpp. One work-item an output
// sample: dimension 0 runs along x, dimension 1 over the rows of a slab of whole slices.
// Built with SAMPLE (uchar or short) and BIAS (0 or 32768, which makes short samples unsigned).
kernel void upsample_trilinear(global const SAMPLE* input, global const struct UpsampleTapLayout* taps_x,
                               global const struct UpsampleTapLayout* taps_y,
                               global const struct UpsampleTapLayout* taps_z, struct UpsampleArguments a,
                               global SAMPLE* slab) {
  const uint u = get_global_id(0);
  const uint row = get_global_id(1);
  if (u >= a.output_x) return;
  const struct UpsampleTapLayout x = taps_x[u], y = taps_y[row % a.output_y], z = taps_z[a.first_slice + row / a.output_y];
  const size_t slice = (size_t)a.input_x * a.input_y;
  global const SAMPLE* ll = input + slice * z.low + (size_t)a.input_x * y.low;
  global const SAMPLE* hl = input + slice * z.low + (size_t)a.input_x * y.high;
  global const SAMPLE* lh = input + slice * z.high + (size_t)a.input_x * y.low;
  global const SAMPLE* hh = input + slice * z.high + (size_t)a.input_x * y.high;
  const uint wll = y.low_weight * z.low_weight, whl = y.high_weight * z.low_weight;
  const uint wlh = y.low_weight * z.high_weight, whh = y.high_weight * z.high_weight;
  const uint low = wll * (uint)(ll[x.low] + BIAS) + whl * (uint)(hl[x.low] + BIAS) + wlh * (uint)(lh[x.low] + BIAS) +
                   whh * (uint)(hh[x.low] + BIAS);
  const uint high = wll * (uint)(ll[x.high] + BIAS) + whl * (uint)(hl[x.high] + BIAS) +
                    wlh * (uint)(lh[x.high] + BIAS) + whh * (uint)(hh[x.high] + BIAS);
  const uint sum = x.low_weight * low + x.high_weight * high;
  slab[(size_t)row * a.output_x + u] = (SAMPLE)((int)((sum + a.rounding) / a.divisor) - BIAS);
}
