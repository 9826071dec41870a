#include "fe/mesh_writers.hpp"

#include <array>

#include "core/thread_pool.hpp"
#include "fe/node_numbering.hpp"

namespace ream::fe {
namespace {

constexpr uint8_t vtk_hexahedron = 12;
constexpr uint64_t corners_of_element = 8;

/// One array of the appended data: its bytes' number stands before them.
struct Block {
  const char* type;
  std::string attributes;
  uint64_t bytes = 0, offset = 0;
};

/// Ids as 32 bits where they fit, as nearly always.
bool small(const NumberedMesh& mesh) {
  return mesh.numbering.elements() * corners_of_element < uint64_t{1} << 31;
}

enum ArrayId { points, connectivity, offsets, types, gray, modulus, material, array_count };

std::array<Block, array_count> blocks_of(const NumberedMesh& mesh) {
  const uint64_t n = mesh.numbering.elements(), index = small(mesh) ? 4 : 8;
  const char* const index_type = small(mesh) ? "Int32" : "Int64";
  std::array<Block, array_count> blocks{{
      {"Float64", R"(Name="Points" NumberOfComponents="3")", mesh.numbering.nodes() * 24},
      {index_type, R"(Name="connectivity")", n * corners_of_element * index},
      {index_type, R"(Name="offsets")", n * index},
      {"UInt8", R"(Name="types")", n},
      {"Float32", R"(Name="gray")", n * 4},
      {"Float32", R"(Name="modulus_MPa")", n * 4},
      {"Int32", R"(Name="material")", n * 4},
  }};
  uint64_t offset = 0;
  for (Block& block : blocks) {
    block.offset = offset;
    offset += sizeof(uint64_t) + block.bytes;
  }
  return blocks;
}

std::string head_of(const NumberedMesh& mesh, const std::array<Block, array_count>& blocks) {
  const auto array = [&](ArrayId which) {
    const Block& b = blocks[which];
    return "<DataArray type=\"" + std::string(b.type) + "\" " + b.attributes +
           " format=\"appended\" offset=\"" + std::to_string(b.offset) + "\"/>\n";
  };
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
         "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
         std::to_string(mesh.numbering.nodes()) + "\" NumberOfCells=\"" +
         std::to_string(mesh.numbering.elements()) + "\">\n<Points>\n" + array(points) +
         "</Points>\n<Cells>\n" + array(connectivity) + array(offsets) + array(types) +
         "</Cells>\n<CellData>\n" + array(gray) + array(modulus) + array(material) +
         "</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
}

/// Writes values of one array at their place in the file.
class ArrayWriter {
 public:
  ArrayWriter(const AtomicFile& file, uint64_t data_begin, const Block& block)
      : file_(file), begin_(data_begin + block.offset + sizeof(uint64_t)) {
    file.write_at(data_begin + block.offset, std::as_bytes(std::span(&block.bytes, 1)));
  }
  template <typename T>
  void write(uint64_t first, const std::vector<T>& values) const {
    if (!values.empty()) file_.write_at(begin_ + first * sizeof(T), std::as_bytes(std::span(values)));
  }

 private:
  const AtomicFile& file_;
  uint64_t begin_;
};

void write_points(const NumberedMesh& mesh, const ArrayWriter& out, const Progress& progress) {
  const Vec3 &first = mesh.model.origin_mm, &step = mesh.model.spacing_mm;
  const auto work = [&](size_t slab) {
    std::vector<double> values;
    for_each_corner_row(mesh.numbering, slab, [&](int v, int w, const CornerRow& row) {
      const double y = first.y() + v * step.y(), z = first.z() + w * step.z();
      for_each_run(row.words().data(), row.words().size(), [&](int begin, int end) {
        for (int u = begin; u < end; ++u) values.insert(values.end(), {first.x() + u * step.x(), y, z});
      });
    });
    out.write(3 * mesh.numbering.nodes_before(slab), values);
  };
  parallel_for(2, mesh.numbering.corners().count(), work, progress, "writing points");
}

template <typename Index>
void write_cells(const NumberedMesh& mesh, const ArrayWriter& corners, const ArrayWriter& ends,
                 const ArrayWriter& kinds, const Progress& progress) {
  const auto work = [&](size_t slab) {
    const uint64_t before = mesh.numbering.elements_before(slab),
                   count = mesh.numbering.elements_before(slab + 1) - before;
    if (count == 0) return;
    std::vector<Index> ids;
    ids.reserve(count * corners_of_element);
    for_each_element_run<CornerRow>(
        mesh.numbering, slab, [&](int, int begin, int end, const CornerRow* rows) {
          Index node[4];  // points count from 0
          for (int k = 0; k < 4; ++k)
            node[k] = static_cast<Index>(rows[k].first_id() + rows[k].rank(begin) - 1);
          for (int u = begin; u < end; ++u) {
            ids.insert(ids.end(), {node[0], node[0] + 1, node[1] + 1, node[1], node[2], node[2] + 1,
                                   node[3] + 1, node[3]});
            for (Index& n : node) ++n;
          }
        });
    corners.write(before * corners_of_element, ids);
    std::vector<Index> end_of(count);
    for (uint64_t i = 0; i < count; ++i)
      end_of[i] = static_cast<Index>((before + i + 1) * corners_of_element);
    ends.write(before, end_of);
    kinds.write(before, std::vector<uint8_t>(count, vtk_hexahedron));
  };
  parallel_for(2, mesh.numbering.voxels().count(), work, progress, "writing elements");
}

void write_values(const NumberedMesh& mesh, const ArrayWriter& grays, const ArrayWriter& moduli,
                  const ArrayWriter& materials, const Progress& progress) {
  constexpr uint64_t block = 1 << 20;
  const uint64_t count = mesh.numbering.elements();
  const auto work = [&](size_t i) {
    const uint64_t first = i * block;
    std::vector<uint16_t> scratch;
    const auto codes = mesh.model.codes.read(first, std::min(block, count - first), scratch);
    std::vector<float> g, e;
    std::vector<int32_t> m;
    for (const uint16_t code : codes) {
      const uint32_t of_code = mesh.materials.of_code[code];
      g.push_back(static_cast<float>(mesh.model.gray.value(code)));
      e.push_back(static_cast<float>(mesh.materials.list[of_code].modulus_mpa));
      m.push_back(static_cast<int32_t>(of_code + 1));
    }
    grays.write(first, g);
    moduli.write(first, e);
    materials.write(first, m);
  };
  parallel_for(2, (count + block - 1) / block, work, progress, "writing values");
}

}  // namespace

uint64_t write_vtu(const NumberedMesh& mesh, const AtomicFile& file, const Progress& progress) {
  const auto blocks = blocks_of(mesh);
  const std::string head = head_of(mesh, blocks), tail = "\n</AppendedData>\n</VTKFile>\n";
  file.write_at(0, std::as_bytes(std::span(head)));
  const auto out = [&](ArrayId which) { return ArrayWriter(file, head.size(), blocks[which]); };
  write_points(mesh, out(points), part_of(progress, 0.0, 0.4));
  const Progress cells = part_of(progress, 0.4, 0.9);
  if (small(mesh))
    write_cells<int32_t>(mesh, out(connectivity), out(offsets), out(types), cells);
  else
    write_cells<int64_t>(mesh, out(connectivity), out(offsets), out(types), cells);
  write_values(mesh, out(gray), out(modulus), out(material), part_of(progress, 0.9, 1.0));
  const uint64_t end = head.size() + blocks[material].offset + sizeof(uint64_t) + blocks[material].bytes;
  file.write_at(end, std::as_bytes(std::span(tail)));
  return end + tail.size();
}

}  // namespace ream::fe
