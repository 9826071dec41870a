#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string_view>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/progress.hpp"
#include "core/thread_pool.hpp"
#include "fe/materials.hpp"
#include "fe/mesh_writers.hpp"
#include "fe/node_numbering.hpp"
#include "fe/number_text.hpp"

namespace ream::fe {
namespace {

/// Where each piece begins, known once all before it have been made.
class Places {
 public:
  explicit Places(uint64_t begin) : next_begin_(begin) {}

  uint64_t of(size_t i, size_t bytes) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return next_ == i || given_up_; });
    if (given_up_) throw Error(ErrorKind::cancelled, "given up with the rest of the file");
    const uint64_t begin = next_begin_;
    next_begin_ += bytes;
    ++next_;
    changed_.notify_all();
    return begin;
  }
  void give_up() {
    const std::lock_guard lock(mutex_);
    given_up_ = true;
    changed_.notify_all();
  }
  uint64_t end() const { return next_begin_; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  size_t next_ = 0;
  uint64_t next_begin_;
  bool given_up_ = false;
};

/// Buffers that are used again, so that their pages are touched for the first time once.
class Buffers {
 public:
  struct Buffer {
    std::unique_ptr<char[]> bytes;
    size_t size = 0;
  };
  Buffer take(size_t size) {
    Buffer buffer;
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) {
        buffer = std::move(free_.back());
        free_.pop_back();
      }
    }
    if (buffer.size < size) buffer = {std::unique_ptr<char[]>(new char[size]), size};
    return buffer;
  }
  void give_back(Buffer buffer) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(buffer));
  }

 private:
  std::mutex mutex_;
  std::vector<Buffer> free_;
};

/// Nodes that stop a body on a sliding platen from drifting and from turning.
struct Pins {
  uint64_t held = 0, guided = 0;
};

/// The least face's first node, and the farthest from it along the first axis across among those level with
/// it along the second.
Pins pins_on(const NodeNumbering& numbering, int axis) {
  const int along = (axis + 1) % 3, level = (axis + 2) % 3;
  Pins pins;
  Vec3i held = Vec3i::Zero();
  int farthest = 0;
  for_each_face_node(numbering, [&](int face, const Vec3i& corner, uint64_t id) {
    if (face != 2 * axis) return;
    if (pins.held == 0) {
      pins.held = id;
      held = corner;
    }
    const int distance = std::abs(corner[along] - held[along]);
    if (corner[level] != held[level] || distance <= farthest) return;
    farthest = distance;
    pins.guided = id;
  });
  return pins;
}

std::string fixed(const std::string& nodes, int direction, const std::string& value = "0.0") {
  const std::string d = std::to_string(direction + 1);
  return nodes + ", " + d + ", " + d + ", " + value + "\n";
}

/// Text at the end of a file in progress, made piece by piece on two threads and written in order.
class OrderedOutput {
 public:
  explicit OrderedOutput(const AtomicFile& file) : file_(file) {}

  void append(std::string_view text);

  struct Pieces {
    size_t count = 0;
    std::function<size_t(size_t i)> max_bytes;      ///< of piece i
    std::function<char*(size_t i, char* at)> make;  ///< writes it from `at` on, returns its end
  };
  /// Errors: io; what the functions and the progress throw.
  void append(const Pieces& pieces, const Progress& progress, std::string_view step);

  uint64_t bytes() const { return bytes_; }

 private:
  const AtomicFile& file_;
  uint64_t bytes_ = 0;
};

void OrderedOutput::append(std::string_view text) {
  file_.write_at(bytes_, std::as_bytes(std::span(text)));
  bytes_ += text.size();
}

void OrderedOutput::append(const Pieces& pieces, const Progress& progress, std::string_view step) {
  Places places(bytes_);
  Buffers buffers;
  const auto work = [&](size_t i) {
    Buffers::Buffer buffer;
    size_t size = 0;
    try {
      buffer = buffers.take(pieces.max_bytes(i));
      size = static_cast<size_t>(pieces.make(i, buffer.bytes.get()) - buffer.bytes.get());
    } catch (...) {
      places.give_up();
      throw;
    }
    const uint64_t begin = places.of(i, size);
    file_.write_at(begin, std::as_bytes(std::span(buffer.bytes.get(), size)));
    buffers.give_back(std::move(buffer));
  };
  parallel_for(2, pieces.count, work, progress, step);
  bytes_ = places.end();
}

}  // namespace

double compression_mm(const Compression& compression, const NodeNumbering& numbering,
                      const Vec3& spacing_mm) {
  const MeshBounds bounds = bounds_of(numbering.mask());
  const int axis = compression.axis;
  return compression.strain * (bounds.greatest[axis] - bounds.least[axis]) * spacing_mm[axis];
}

std::string compression_text(const Compression& compression, const NodeNumbering& numbering,
                             const Vec3& spacing_mm) {
  const int axis = compression.axis;
  const std::string base = face_names[static_cast<size_t>(2 * axis)],
                    top = face_names[static_cast<size_t>(2 * axis + 1)];
  std::string text = "*BOUNDARY\n" + fixed(base, axis);
  for (const int across : {(axis + 1) % 3, (axis + 2) % 3})
    if (compression.fixed_platens) text += fixed(base, across) + fixed(top, across);
  if (!compression.fixed_platens) {
    const Pins pins = pins_on(numbering, axis);
    text += fixed(std::to_string(pins.held), (axis + 1) % 3) +
            fixed(std::to_string(pins.held), (axis + 2) % 3) +
            fixed(std::to_string(pins.guided), (axis + 2) % 3);
  }
  text += "*STEP\n*STATIC\n*BOUNDARY\n" +
          fixed(top, axis, real_text(-compression_mm(compression, numbering, spacing_mm)));
  for (const std::string& face : {base, top}) text += "*NODE PRINT, NSET=" + face + ", TOTALS=ONLY\nRF\n";
  return text + "*NODE FILE\nU\n*EL FILE\nS, E\n*END STEP\n";
}

namespace {

constexpr size_t max_id_bytes = 10, max_coordinate_bytes = 21, spare_bytes = 64;
constexpr size_t ids_per_line = 16;  // more are refused by CalculiX

std::string heading(const NumberedMesh& mesh) {
  const ElementModel& model = mesh.model;
  std::string text = "*HEADING\nmicro-FE mesh by ream femesh; units mm, N, MPa\n";
  text += "** " + std::to_string(mesh.numbering.elements()) + " elements, " +
          std::to_string(mesh.numbering.nodes()) + " nodes, " + std::to_string(mesh.materials.list.size()) +
          " materials\n** modulus of gray value g, " + mesh.rule.law.description() + "\n";
  if (model.gray_is_density_g_cc) text += "** g is the apparent density in g/cc\n";
  if (!model.source.empty()) text += "** from " + model.source + "\n";
  const Pose& pose = model.world_from_mesh;
  text += "** world (LPS, mm) = R x + t";
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      text += (row + column == 0 ? ", R = " : " ") + real_text(pose.rotation(row, column));
  for (int row = 0; row < 3; ++row) text += (row == 0 ? ", t = " : " ") + real_text(pose.translation_mm[row]);
  return text + "\n";
}

/// Coordinates of all planes of corners along an axis.
std::vector<CoordinateText> coordinates(const ElementModel& model, int axis) {
  const double first = model.origin_mm[axis], step = model.spacing_mm[axis];
  const int decimals = decimals_of(first, step);
  std::vector<CoordinateText> texts;
  for (int i = 0; i <= model.mask.dims()[axis]; ++i)
    texts.push_back(CoordinateText::of(first + i * step, decimals));
  return texts;
}

void write_nodes(const NumberedMesh& mesh, OrderedOutput& out, const Progress& progress) {
  const NodeNumbering& numbering = mesh.numbering;
  const std::vector<CoordinateText> x = coordinates(mesh.model, 0), y = coordinates(mesh.model, 1),
                                    z = coordinates(mesh.model, 2);
  out.append("*NODE, NSET=NALL\n");
  const auto max_bytes = [&](size_t i) {
    return (numbering.nodes_before(i + 1) - numbering.nodes_before(i)) *
               (max_id_bytes + 3 * max_coordinate_bytes) +
           spare_bytes;
  };
  const auto make = [&](size_t slab, char* at) {
    for_each_corner_row(numbering, slab, [&](int v, int w, const CornerRow& row) {
      char tail[80] = {','};
      char* end = y[static_cast<size_t>(v)].append(tail + 1);
      *end++ = ',';
      end = z[static_cast<size_t>(w)].append(end);
      *end++ = '\n';
      const auto tail_bytes = static_cast<size_t>(end - tail);
      IdText id;
      uint64_t number = row.first_id();
      id.set(number);
      for_each_run(row.words().data(), row.words().size(), [&](int begin, int stop) {
        for (int u = begin; u < stop; ++u) {
          at = id.append(at);
          at = x[static_cast<size_t>(u)].append(at);
          std::memcpy(at, tail, 48);
          at += tail_bytes;
          id.step(++number);
        }
      });
    });
    return at;
  };
  out.append({numbering.corners().count(), max_bytes, make}, progress, "writing nodes");
}

/// A row of corners with the texts of its ids.
struct TextRow : CornerRow {
  std::vector<IdText> ids;

  uint64_t load(const NodeNumbering& numbering, int v, int w, uint64_t first) {
    const uint64_t next = CornerRow::load(numbering, v, w, first);
    ids.resize(count() + 1);
    ids[0].set(first);
    for (size_t i = 1; i < count(); ++i) {
      ids[i] = ids[i - 1];
      ids[i].step(first + i);
    }
    return next;
  }
};

/// A run of elements side by side.
char* element_lines(const TextRow* rows, int begin, int end, uint64_t& number, IdText& id, char* at) {
  const IdText* front_low = rows[0].ids.data() + rows[0].rank(begin);
  const IdText* back_low = rows[1].ids.data() + rows[1].rank(begin);
  const IdText* front_high = rows[2].ids.data() + rows[2].rank(begin);
  const IdText* back_high = rows[3].ids.data() + rows[3].rank(begin);
  for (int u = begin; u < end; ++u) {
    at = id.append(at);
    at = front_low[0].append(at);
    at = front_low[1].append(at);
    at = back_low[1].append(at);
    at = back_low[0].append(at);
    at = front_high[0].append(at);
    at = front_high[1].append(at);
    at = back_high[1].append(at);
    at = back_high[0].append(at);
    at[-1] = '\n';
    ++front_low, ++back_low, ++front_high, ++back_high;
    id.step(++number);
  }
  return at;
}

void write_elements(const NodeNumbering& numbering, OrderedOutput& out, const Progress& progress) {
  out.append("*ELEMENT, TYPE=C3D8, ELSET=EALL\n");
  const auto max_bytes = [&](size_t i) {
    return (numbering.elements_before(i + 1) - numbering.elements_before(i)) * 9 * max_id_bytes + spare_bytes;
  };
  const auto make = [&](size_t slab, char* at) {
    if (numbering.elements_before(slab + 1) == numbering.elements_before(slab)) return at;
    uint64_t number = numbering.elements_before(slab) + 1;
    IdText id;
    id.set(number);
    for_each_element_run<TextRow>(numbering, slab, [&](int, int begin, int end, const TextRow* rows) {
      at = element_lines(rows, begin, end, number, id, at);
    });
    return at;
  };
  out.append({numbering.voxels().count(), max_bytes, make}, progress, "writing elements");
}

char* id_lines(std::span<const uint32_t> ids, char* at) {
  for (size_t i = 0; i < ids.size(); ++i) {
    IdText id;
    id.set(ids[i]);
    at = id.append(at);
    if (i % ids_per_line == ids_per_line - 1 || i + 1 == ids.size()) at[-1] = '\n';
  }
  return at;
}

std::string set_name(size_t material) { return "SET_" + std::to_string(material + 1); }

void write_sets(const NumberedMesh& mesh, MemoryBudget& budget, OrderedOutput& out,
                const Progress& progress) {
  const Materials& materials = mesh.materials;
  if (materials.list.size() == 1) {
    out.append("*ELSET, ELSET=SET_1, GENERATE\n1, " + std::to_string(mesh.numbering.elements()) + ", 1\n");
    return;
  }
  for_each_part_of_sets(mesh.model.codes, materials, budget, [&](const SetsPart& part) {
    struct Piece {
      size_t material;
      std::span<const uint32_t> ids;
      bool first;
    };
    constexpr size_t max_ids = ids_per_line << 12;
    std::vector<Piece> pieces;
    for (size_t m = part.first_material; m < part.end_material; ++m) {
      const std::span<const uint32_t> ids = part.ids_of(m);
      for (size_t i = 0; i < ids.size(); i += max_ids)
        pieces.push_back({m, ids.subspan(i, std::min(max_ids, ids.size() - i)), i == 0});
    }
    const auto max_bytes = [&](size_t i) {
      return pieces[i].ids.size() * (max_id_bytes + 1) + 2 * spare_bytes;
    };
    const auto make = [&](size_t i, char* at) {
      if (pieces[i].first) {
        const std::string head = "*ELSET, ELSET=" + set_name(pieces[i].material) + "\n";
        at = std::copy(head.begin(), head.end(), at);
      }
      return id_lines(pieces[i].ids, at);
    };
    out.append({pieces.size(), max_bytes, make}, progress, "writing element sets");
  });
}

void write_materials(const NumberedMesh& mesh, OrderedOutput& out) {
  std::string text;
  for (size_t m = 0; m < mesh.materials.list.size(); ++m) {
    const std::string number = std::to_string(m + 1);
    text += "*MATERIAL, NAME=MAT_" + number + "\n*ELASTIC\n" + real_text(mesh.materials.list[m].modulus_mpa) +
            ", " + real_text(mesh.rule.poisson) + "\n*SOLID SECTION, ELSET=" + set_name(m) +
            ", MATERIAL=MAT_" + number + "\n";
  }
  out.append(text);
}

void write_faces(const NodeNumbering& numbering, OrderedOutput& out) {
  const auto faces = face_nodes(numbering);
  for (size_t face = 0; face < faces.size(); ++face) {
    out.append(std::string("*NSET, NSET=") + face_names[face] + "\n");
    std::string text(faces[face].size() * (max_id_bytes + 1) + spare_bytes, '\0');
    const char* end = id_lines(faces[face], text.data());
    out.append(std::string_view(text.data(), static_cast<size_t>(end - text.data())));
  }
}

}  // namespace

uint64_t write_inp(const NumberedMesh& mesh, const InpOptions& options, MemoryBudget& budget,
                   const AtomicFile& file, const Progress& progress) {
  OrderedOutput out(file);
  out.append(heading(mesh));
  write_nodes(mesh, out, part_of(progress, 0.0, 0.4));
  write_elements(mesh.numbering, out, part_of(progress, 0.4, 0.9));
  write_sets(mesh, budget, out, part_of(progress, 0.9, 1.0));
  write_materials(mesh, out);
  if (options.faces || options.compression) write_faces(mesh.numbering, out);
  if (options.compression)
    out.append(compression_text(*options.compression, mesh.numbering, mesh.model.spacing_mm));
  return out.bytes();
}

}  // namespace ream::fe
