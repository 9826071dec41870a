#include "ct/segment/shoulder_steps.hpp"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <cmath>

#include "ct/segment/bone_filters.hpp"
#include "ct/segment/mask.hpp"
#include "ct/segment/voxel_window.hpp"

namespace ream::ct {
namespace {

constexpr auto scapula = static_cast<uint8_t>(BoneLabel::scapula);
constexpr double valley_radius_mm = 2.0;  // joint spaces are 2 to 4 mm wide
constexpr int32_t unbreakable = 1'000'000'000;

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
struct Node {
  boost::default_color_type colour = boost::black_color;
  int32_t distance = 0;
  Traits::edge_descriptor towards;
};
struct Arc {
  int32_t capacity = 0, left = 0;
  Traits::edge_descriptor back;
};
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, Node, Arc>;

void join(Graph& graph, size_t a, size_t b, int32_t forth, int32_t back) {
  const auto there = boost::add_edge(a, b, graph).first, again = boost::add_edge(b, a, graph).first;
  graph[there].capacity = forth;
  graph[again].capacity = back;
  graph[there].back = again;
  graph[again].back = there;
}

/// What parting two neighbours costs, by the lesser of their HU and the deeper of their valleys.
int32_t cost_of_cut(int hu, int valley_hu, double threshold_hu, double face_mm2) {
  constexpr double unit = 1000.0, scale_hu = 150.0, valley_scale_hu = 60.0, max_cost = 100.0;
  const double above = std::max(0.0, hu - threshold_hu) / scale_hu, valley = valley_hu / valley_scale_hu;
  const double cost = std::min(max_cost, (1.0 + above * above) / (1.0 + valley * valley));
  return static_cast<int32_t>(std::lround(std::max(1.0, unit * face_mm2 * cost)));
}

/// Voxels on either side of the border.
Mask border_of(const std::vector<uint8_t>& labels, const Vec3i& dims) {
  Mask border(labels.size());
  const Steps steps(dims);
  for (size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != scapula) continue;
    each_face_neighbour(steps, i, [&](size_t n) {
      if (labels[n] != 0 && labels[n] != scapula) border[i] = border[n] = 1;
    });
  }
  return border;
}

/// One window's voxels and the graph over those that may change sides.
struct Cut {
  std::vector<uint8_t> labels, markers;
  Mask solid;  ///< labelled voxels and the marrow within
  std::vector<int16_t> hu, valley_hu;
  std::vector<float> distance;  ///< from the border
  std::vector<size_t> node;     ///< of each voxel; 0 where it keeps its label
  std::vector<size_t> voxels;   ///< of each node from 2 on: nodes 0 and 1 are scapula and the rest
};

void number_nodes(Cut& cut, double reach_mm) {
  cut.node.assign(cut.labels.size(), 0);
  cut.voxels.assign(2, 0);
  for (size_t i = 0; i < cut.labels.size(); ++i)
    if (cut.solid[i] && cut.markers[i] == 0 && static_cast<double>(cut.distance[i]) <= reach_mm) {
      cut.node[i] = cut.voxels.size();
      cut.voxels.push_back(i);
    }
}

Graph graph_of(const Cut& cut, const Vec3i& dims, const Vec3& spacing_mm, double threshold_hu) {
  Graph graph(cut.voxels.size());
  const Steps steps(dims);
  for (size_t node = 2; node < cut.voxels.size(); ++node) {
    const size_t i = cut.voxels[node];
    int32_t to_scapula = 0, to_rest = 0;
    each_face_neighbour(steps, i, [&](size_t n) {
      if (!cut.solid[n] || (cut.node[n] == 0 && cut.labels[n] == 0)) return;
      const size_t step = n > i ? n - i : i - n;
      const double face_mm2 = step == 1          ? spacing_mm.y() * spacing_mm.z()
                              : step == steps.nx ? spacing_mm.x() * spacing_mm.z()
                                                 : spacing_mm.x() * spacing_mm.y();
      const int32_t cost = cost_of_cut(std::min(cut.hu[i], cut.hu[n]),
                                       std::max(cut.valley_hu[i], cut.valley_hu[n]), threshold_hu, face_mm2);
      if (cut.node[n] > node)
        join(graph, node, cut.node[n], cost, cost);
      else if (cut.node[n] == 0)
        (cut.labels[n] == scapula ? to_scapula : to_rest) += cost;
    });
    if (to_scapula > 0) join(graph, 0, node, std::min(to_scapula, unbreakable), 0);
    if (to_rest > 0) join(graph, node, 1, std::min(to_rest, unbreakable), 0);
  }
  return graph;
}

/// Gives each voxel that the cut leaves on the other side the label of the nearest voxel there.
void take_sides(Cut& cut, const Graph& graph, const Vec3i& dims) {
  constexpr uint8_t undecided = 255;
  const Steps steps(dims);
  std::vector<size_t> pending;
  for (size_t node = 2; node < cut.voxels.size(); ++node) {
    uint8_t& label = cut.labels[cut.voxels[node]];
    // Black is joined to node 0, white to node 1, grey to neither: that keeps its label.
    if (label == 0) continue;
    if (graph[node].colour == boost::black_color) label = scapula;
    if (graph[node].colour == boost::white_color && label == scapula) label = undecided;
  }
  for (size_t i = 0; i < cut.labels.size(); ++i)
    if (cut.labels[i] > scapula && cut.labels[i] != undecided) pending.push_back(i);
  for (size_t k = 0; k < pending.size(); ++k)
    each_face_neighbour(steps, pending[k], [&](size_t n) {
      if (cut.labels[n] != undecided) return;
      cut.labels[n] = cut.labels[pending[k]];
      pending.push_back(n);
    });
  for (uint8_t& label : cut.labels)
    if (label == undecided) label = 0;
}

}  // namespace

void cut_at_necks(std::vector<uint8_t>& labels, const std::vector<uint8_t>& markers, const HuVolume& volume,
                  double threshold_hu, double reach_mm) {
  const Mask border = border_of(labels, volume.dims);
  if (count_set(border) == 0) return;
  const VoxelWindow window = widened(window_of_set(border, volume.dims), volume.dims, volume.spacing_mm,
                                     reach_mm + volume.spacing_mm.maxCoeff());
  Cut cut;
  cut.labels = cut_out(labels, volume.dims, window);
  cut.markers = cut_out(markers, volume.dims, window);
  cut.hu = cut_out(volume.hu, volume.dims, window);
  cut.valley_hu = valley_depth_hu(cut.hu, window.dims, volume.spacing_mm, valley_radius_mm);
  cut.distance = distance_to_set_mm(cut_out(border, volume.dims, window), window.dims, volume.spacing_mm);
  cut.solid.resize(cut.labels.size());
  std::transform(cut.labels.begin(), cut.labels.end(), cut.solid.begin(),
                 [](uint8_t label) { return uint8_t{label != 0}; });
  fill_marrow(cut.solid, window.dims, 1);
  number_nodes(cut, reach_mm);
  Graph graph = graph_of(cut, window.dims, volume.spacing_mm, threshold_hu);
  boost::boykov_kolmogorov_max_flow(graph, boost::get(&Arc::capacity, graph), boost::get(&Arc::left, graph),
                                    boost::get(&Arc::back, graph), boost::get(&Node::towards, graph),
                                    boost::get(&Node::colour, graph), boost::get(&Node::distance, graph),
                                    boost::get(boost::vertex_index, graph), 0, 1);
  take_sides(cut, graph, window.dims);
  put_back(labels, volume.dims, window, cut.labels);
}

}  // namespace ream::ct
