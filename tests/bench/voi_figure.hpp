#pragma once
#include "bench/bench.hpp"

namespace ream::bench {

/// Figure 4.4 as columns of numbers: contact with and without a volume of interest against the volume that
/// tool and bone share, for the thesis' flat kernel and for this program, Voxmap and PointShell at 512^3.
std::vector<Row> voi_figure(const Options& options);

}  // namespace ream::bench
