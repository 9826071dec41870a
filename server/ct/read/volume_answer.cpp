#include "ct/read/volume_answer.hpp"

#include <Eigen/LU>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/json_reader.hpp"
#include "core/text.hpp"
#include "ct/read/read_ct.hpp"

namespace ream::ct {
using nlohmann::json;
namespace {

constexpr int max_side = 65535;
constexpr double max_mm = 1.0e6, rotation_tolerance = 1e-6;
constexpr size_t max_warnings = 200, max_warning_bytes = 1000;

Error impossible(const std::string& what) {
  return {ErrorKind::io, "the reader answered with an impossible volume: " + what};
}

}  // namespace

json answer_of(const HuVolume& volume) {
  json rotation = json::array();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      rotation.push_back(volume.world_from_volume.rotation(row, column));
  const auto triple = [](const auto& v) { return json{v.x(), v.y(), v.z()}; };
  json answer{{"dims", triple(volume.dims)}, {"spacing_mm", triple(volume.spacing_mm)},
              {"rotation", rotation},        {"origin_mm", triple(volume.world_from_volume.translation_mm)},
              {"source", volume.source},     {"warnings", volume.warnings}};
  if (volume.patient) answer["patient"] = {volume.patient->name, volume.patient->id};
  return answer;
}

HuVolume volume_from(const json& answer, bool flat) {
  JsonReader reader(answer, "the answer of the reader");
  HuVolume volume;
  const auto dims = reader.numbers("dims", 3), spacing = reader.numbers("spacing_mm", 3),
             rotation = reader.numbers("rotation", 9), origin = reader.numbers("origin_mm", 3);
  double voxels = 1.0;
  for (int k = 0; k < 3; ++k) {
    const double n = dims[static_cast<size_t>(k)], size = spacing[static_cast<size_t>(k)];
    if (!(n >= (flat ? 1 : 2) && n <= max_side)) throw impossible("its sides");
    if (!(size > 0.0 && size < max_mm && std::abs(origin[static_cast<size_t>(k)]) < max_mm * max_mm))
      throw impossible("its place");
    volume.dims[k] = static_cast<int>(n);
    voxels *= volume.dims[k];
    volume.spacing_mm[k] = size;
    volume.world_from_volume.translation_mm[k] = origin[static_cast<size_t>(k)];
    for (int column = 0; column < 3; ++column)
      volume.world_from_volume.rotation(k, column) = rotation[static_cast<size_t>(3 * k + column)];
  }
  const Mat3& r = volume.world_from_volume.rotation;
  if (voxels > max_ct_voxels) throw impossible("its number of voxels");
  if (!((r.transpose() * r - Mat3::Identity()).cwiseAbs().maxCoeff() < rotation_tolerance) ||
      r.determinant() < 0.0)
    throw impossible("its axes");
  volume.source = one_line(reader.text("source"), max_warning_bytes);
  for (const std::string& warning : reader.texts_or_none("warnings"))
    if (volume.warnings.size() < max_warnings)
      volume.warnings.push_back(one_line(warning, max_warning_bytes));
  const auto patient = reader.texts_or_none("patient");
  if (patient.size() == 2)
    volume.patient =
        PatientNames{one_line(patient[0], max_warning_bytes), one_line(patient[1], max_warning_bytes)};
  return volume;
}

void write_values(const std::filesystem::path& file, const void* values, size_t count) {
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out.write(static_cast<const char*>(values), static_cast<std::streamsize>(count * sizeof(uint16_t)));
  if (!out.flush())
    throw Error(ErrorKind::io, "there is no room on the disk for the values of the volume (" +
                                   std::to_string(count * sizeof(uint16_t) / 1'000'000) + " MB more)");
}

}  // namespace ream::ct
