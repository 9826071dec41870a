#pragma once
#include "bench/bench.hpp"
#include "bench/validate/plots.hpp"
#include "bench/validate/published.hpp"

namespace ream::bench {

inline constexpr const PublishedBone* published_bones[] = {&published_cortical, &published_cancellous};

/// Feed at four thrusts on each specimen's density, against the law, and table 5.1 with figures 5.4 and 5.5.
std::vector<Row> feed_rows(const Options& options, Plots& plots);
/// Impedance beside admittance, and the ripple of the hand's force.
std::vector<Row> steady_rows(const Options& options);
/// The experiments' protocol on layered slabs: figures 5.2 and 5.3.
std::vector<Row> protocol_rows(const Options& options, Plots& plots);
/// The same with a robot whose force scatters as the published one did, eight times over.
std::vector<Row> scatter_rows(const Options& options);
/// The model that a session has unless it says otherwise, with the thesis' reamer and with flat punches.
std::vector<Row> edge_rows(const Options& options);
/// A minute of each bone's vibration: table 5.2 and figures 5.6 to 5.9.
std::vector<Row> vibration_rows(const Options& options, Plots& plots);

/// Density and subchondral plate through scans of a glenoid that is known by formulas, of coarse voxels and
/// of fine ones.
std::vector<Row> scan_rows(const Options& options);
std::vector<Row> fine_scan_rows(const Options& options);
/// Version and inclination by landmarks that are found on scanned scapulae.
std::vector<Row> version_rows(const Options& options);

/// What force and motion cost the tick, beside contact and removal.
std::vector<Row> force_cost_rows();

/// How far `ours` is from `theirs`, percent of theirs.
double percent_off(double ours, double theirs);

}  // namespace ream::bench
