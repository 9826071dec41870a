#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "module/arrays.hpp"
#include "module/bindings.hpp"
#include "module/computing.hpp"
#include "module/tick_rows.hpp"
#include "record/recorded_bone.hpp"
#include "session/replay/verify_replay.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/recorded_session.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "sim/model.hpp"

namespace ream::python {
namespace {

namespace py = pybind11;
using nlohmann::json;

/// What an op says, but for bytes; numbers that JSON cannot hold exactly as text.
template <typename Op>
json op_json(const Op& op) {
  json told = json::object();
  size_t at = 0;
  Op::visit_fields(op, [&](const auto& field, uint32_t) {
    const std::string name(Op::field_names[at++]);
    using Field = std::decay_t<decltype(field)>;
    if constexpr (std::is_same_v<Field, uint64_t>)
      told[name] = name.ends_with("hash") ? json(to_hex(field)) : json(field);
    else if constexpr (std::is_arithmetic_v<Field> || std::is_same_v<Field, std::string>)
      told[name] = field;
  });
  return told;
}

template <typename Op>
json op_list(const std::vector<Op>& ops) {
  json list = json::array();
  for (const Op& op : ops) list.push_back(op_json(op));
  return list;
}

/// Text that is JSON itself stays text here; python/ream/recording.py reads it.
std::string notes_of(const record::Recording& recording) {
  json notes{{"header", op_json(recording.header())},
             {"segments", op_list(recording.segments())},
             {"events", op_list(recording.events())},
             {"annotations", op_list(recording.annotations())},
             {"end", recording.end() ? op_json(*recording.end()) : json(nullptr)},
             {"path", recording.log().path().string()},
             {"damage", recording.log().damage()}};
  return notes.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::vector<record::ops::Tick> rows_of(const record::Recording& recording, int64_t first, int64_t last) {
  if (first < 0 || last < first)
    throw Error(ErrorKind::invalid_input,
                "ticks are asked for from the first, 0 or more, to one after the last");
  const int64_t count = recording.tick_count();
  first = std::min(first, count), last = std::min(last, count);
  const Computing computing;
  std::vector<record::ops::Tick> rows;
  rows.reserve(static_cast<size_t>(last - first));  // a row is large: it is not to be moved again and again
  recording.for_each_tick(static_cast<uint32_t>(first), static_cast<uint32_t>(last),
                          [&](const record::ops::Tick& tick) { rows.push_back(tick); });
  return rows;
}

/// Levels of coverage that the ticks before `first` removed.
int64_t removed_before(const record::Recording& recording, int64_t first) {
  int64_t removed = 0;
  for (const record::ops::Tick& tick : rows_of(recording, 0, first))
    removed += int64_t{tick.removed_cancellous} + tick.removed_cortical + tick.removed_cartilage;
  return removed;
}

Pose world_from_plan(const record::Recording& recording) {
  return sim::world_from_plan(session::recorded_plan(recording));
}

py::array coverage_at(const record::Recording& recording, int64_t tick, const std::string& case_name,
                      const std::filesystem::path& data) {
  if (tick < 0 || tick > int64_t{recording.tick_count()})
    throw Error(ErrorKind::invalid_input,
                "the recording has moments from 0 to " + std::to_string(recording.tick_count()) + " ticks");
  auto coverage = std::make_unique<std::vector<uint8_t>>();
  voxel::VoxelGrid grid;
  {
    const Computing computing;
    const std::lock_guard one_at_a_time(case_mutex());
    case_::Case before = session::case_of(recording, case_name, data);
    grid = before.bone.grid;
    *coverage = before.bone.coverage;
    record::RecordedBone bone(recording, grid, before.bone.coverage);
    bone.seek(static_cast<uint32_t>(tick), [](const voxel::BrickImage&) {});
    bone.write_to(*coverage);
  }
  const uint8_t* bytes = coverage->data();
  const py::capsule owner(coverage.release(), [](void* p) { delete static_cast<std::vector<uint8_t>*>(p); });
  return bytes_view(grid, bytes, owner);
}

session::VerifyResult verified(const record::Recording& recording, const std::string& backend,
                               const std::string& case_name, const std::filesystem::path& data) {
  Computing computing;
  Signals signals(computing);
  session::VerifyRequest request;
  request.backend = backend;
  request.progress = signals.progress();
  case_::Case bone_case = [&] {
    const std::lock_guard one_at_a_time(case_mutex());
    return session::recorded_case(recording, case_name, data);
  }();
  return session::verify_replay(recording, std::move(bone_case), request);
}

std::string verify(const record::Recording& recording, const std::string& backend,
                   const std::string& case_name, const std::filesystem::path& data) {
  const session::VerifyResult result = verified(recording, backend, case_name, data);
  return json{
      {"ticks", result.ticks},
      {"same", !result.difference && result.ticks == recording.tick_count()},
      {"backend", result.backend},
      {"session_hash", to_hex(result.session_hash)},
      {"grid_hash", to_hex(result.grid_hash)},
      {"difference",
       result.difference ? json(session::difference_words(result.ticks, *result.difference)) : json(nullptr)},
      {"left_out", result.left_out}}
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

void bind_recording(py::module_& module) {
  using Data = std::optional<std::filesystem::path>;
  py::class_<record::Recording>(module, "Recording")
      .def(py::init([](const std::string& name, const Data& data) {
        return std::make_unique<record::Recording>(
            session::recording_path(name, data_folder(data.value_or(""))));
      }))
      .def_property_readonly("tick_count", &record::Recording::tick_count)
      .def("notes_json", &notes_of)
      .def("ticks", [](const record::Recording& self, int64_t first,
                       int64_t last) { return tick_array(rows_of(self, first, last)); })
      .def("table",
           [](const record::Recording& self, int64_t first, int64_t last) {
             return trace_arrays(rows_of(self, first, last), self.grid(), world_from_plan(self),
                                 removed_before(self, first));
           })
      .def_property_readonly("spacing_mm",
                             [](const record::Recording& self) {
                               const Vec3 mm = self.grid().spacing_mm;
                               return py::make_tuple(mm.x(), mm.y(), mm.z());
                             })
      .def_property_readonly("world_from_plan",
                             [](const record::Recording& self) { return matrix_of(world_from_plan(self)); })
      .def_property_readonly(
          "world_from_grid",
          [](const record::Recording& self) { return matrix_of(self.grid().world_from_grid); })
      .def("coverage",
           [](const record::Recording& self, int64_t tick, const std::string& case_name, const Data& data) {
             return coverage_at(self, tick, case_name, data_folder(data.value_or("")));
           })
      .def("verify_json",
           [](const record::Recording& self, const std::string& backend, const std::string& case_name,
              const Data& data) { return verify(self, backend, case_name, data_folder(data.value_or(""))); });
}

}  // namespace ream::python
