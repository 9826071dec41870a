#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>

#include "case/plan.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/json.hpp"
#include "module/arrays.hpp"
#include "module/bindings.hpp"
#include "module/computing.hpp"
#include "module/reaming.hpp"
#include "module/tick_rows.hpp"
#include "session/simulation/reamed_pictures.hpp"

namespace ream::python {
namespace {

namespace py = pybind11;
using record::ops::Tick;

constexpr size_t ticks_between_signals = 1000;
/// As the option of `ream simulate` and scripts have them.
constexpr double min_force_scale = 0.01, max_force_scale = 1000.0;

/// A Reaming as Python holds it. Python's other threads go on while it computes, so that two may come at
/// once.
class Simulation {
 public:
  explicit Simulation(ReamingRequest request) : reaming(std::move(request)) {}

  Reaming reaming;

  /// For as long as one call uses the reaming. Error conflict while another thread does.
  class Use {
   public:
    explicit Use(Simulation& simulation) : busy_(simulation.busy_) {
      if (busy_.exchange(true))
        throw Error(ErrorKind::conflict, "another thread is using this simulation; make one for each thread");
    }
    ~Use() { busy_ = false; }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

   private:
    std::atomic<bool>& busy_;
  };

 private:
  std::atomic<bool> busy_{false};
};

/// Property `get(reaming)`, which no other thread changes meanwhile.
template <typename Get>
auto property(Get get) {
  return [get](Simulation& self) {
    const Simulation::Use use(self);
    return get(self.reaming);
  };
}

/// What somebody asks of the drive: one trigger for each pose.
struct Drive {
  std::vector<double> triggers;
  bool reversed = false, irrigating = false;

  Drive(const Doubles& asked, size_t poses, bool reverse, bool irrigate)
      : triggers(asked.data(), asked.data() + asked.size()), reversed(reverse), irrigating(irrigate) {
    if (asked.ndim() != 1 || triggers.size() != poses)
      throw Error(ErrorKind::invalid_input, "there must be one trigger, or one for each pose");
    for (size_t i = 0; i < triggers.size(); ++i)
      if (!(triggers[i] >= 0.0 && triggers[i] <= 1.0))
        throw Error(
            ErrorKind::invalid_input,
            "trigger " + std::to_string(i) + " must be between 0 (the spindle stands) and 1 (full speed)");
  }

  device::DriveControls at(size_t i) const {
    return {static_cast<uint8_t>(std::lround(255.0 * triggers[i])), reversed, irrigating};
  }
};

/// `next(i)` gives row i, or nothing at the end. Ctrl-C ends it; what has been stepped stays.
template <typename Next>
py::array rows_of(size_t most, Next next) {
  std::vector<Tick> rows;
  {
    Computing computing;
    Signals signals(computing);
    for (size_t i = 0; i < most; ++i) {
      const std::optional<Tick> row = next(i);
      if (!row) break;
      rows.push_back(*row);
      if (i % ticks_between_signals == ticks_between_signals - 1) signals.look();
    }
  }
  return tick_array(std::move(rows));
}

py::array run(Simulation& simulation, const Doubles& rows, const Doubles& triggers, bool reversed,
              bool irrigating) {
  const std::vector<Pose> poses = poses_from(rows);
  const Drive drive(triggers, poses.size(), reversed, irrigating);
  const Simulation::Use use(simulation);
  for (const Pose& pose : poses) simulation.reaming.require_in_reach(pose);
  return rows_of(poses.size(), [&](size_t i) -> std::optional<Tick> {
    return simulation.reaming.step(poses[i], drive.triggers[i] > 0.0, drive.at(i));
  });
}

py::array step(Simulation& simulation, const Doubles& row, double trigger, bool reversed, bool irrigating) {
  if (row.ndim() != 1)
    throw Error(ErrorKind::invalid_input, "step() takes one pose; run() takes a list of them");
  const Doubles rows = row.attr("reshape")(1, -1);
  const Pose pose = poses_from(rows).at(0);
  const Drive drive(Doubles(std::vector<py::ssize_t>{1}, &trigger), 1, reversed, irrigating);
  const Simulation::Use use(simulation);
  std::vector<Tick> rows_stepped(1);
  {
    const Computing computing;
    rows_stepped[0] = simulation.reaming.step(pose, trigger > 0.0, drive.at(0));
  }
  return tick_array(std::move(rows_stepped));
}

py::array run_script(Simulation& simulation, int64_t max_ticks) {
  if (max_ticks < 0) throw Error(ErrorKind::invalid_input, "the number of ticks must not be negative");
  const Simulation::Use use(simulation);
  return rows_of(static_cast<size_t>(max_ticks), [&](size_t) { return simulation.reaming.step_script(); });
}

std::unique_ptr<Simulation> make(session::RunRequest run, const std::optional<std::string>& script_json,
                                 const std::string& removal,
                                 const std::optional<std::filesystem::path>& data) {
  if (removal != "profile" && removal != "decay")
    throw Error(ErrorKind::usage, "removal '" + removal + "' is not known; use profile or decay");
  if (run.backend != "cpu" && !run.backend.starts_with("opencl"))
    throw Error(ErrorKind::usage, "backend '" + run.backend + "' is not known; use cpu, opencl or opencl:N");
  if (run.force_scale && !(*run.force_scale >= min_force_scale && *run.force_scale <= max_force_scale))
    throw Error(ErrorKind::usage, "force_scale must be between 0.01 and 1000");
  if (!(run.tool_spacing_mm >= 0.02 && run.tool_spacing_mm <= 5.0))
    throw Error(ErrorKind::usage, "point_spacing_mm must be between 0.02 and 5");
  run.removal = removal == "decay" ? sim::RemovalLaw::decay : sim::RemovalLaw::profile;
  if (script_json) run.script = device::parse_script(parse_json(*script_json), "the script");
  const Computing computing;
  const std::lock_guard one_at_a_time(case_mutex());
  return std::make_unique<Simulation>(ReamingRequest{std::move(run), data_folder(data.value_or(""))});
}

std::optional<shell::ToolAxis> axis_from(const std::optional<std::array<double, 6>>& axis) {
  if (!axis) return std::nullopt;
  const auto& a = *axis;
  return shell::ToolAxis{Vec3(a[0], a[1], a[2]), Vec3(a[3], a[4], a[5])};
}

/// Property `bytes(bone)`, seen. Its memory stays where it is as long as the simulation lives, so that no Use
/// is needed.
template <typename Bytes>
auto view(Bytes bytes) {
  return [bytes](const py::object& self) {
    const voxel::BoneModel& bone = self.cast<Simulation&>().reaming.bone_case().bone;
    return bytes_view(bone.grid, bytes(bone).data(), self);
  };
}

void bind_bone(py::class_<Simulation>& simulation) {
  simulation.def_property_readonly("coverage", view([](const auto& bone) -> auto& { return bone.coverage; }))
      .def_property_readonly("density", view([](const auto& bone) -> auto& { return bone.density; }))
      .def_property_readonly("spacing_mm", property([](const Reaming& reaming) {
                               const Vec3& mm = reaming.bone_case().bone.grid.spacing_mm;
                               return py::make_tuple(mm.x(), mm.y(), mm.z());
                             }))
      .def_property_readonly("grid_hash", property([](const Reaming& reaming) {
                               return to_hex(reaming.bone_case().bone.coverage_hash());
                             }))
      .def_property_readonly("world_from_plan", property([](const Reaming& reaming) {
                               return matrix_of(reaming.model().world_from_plan);
                             }))
      .def_property_readonly("world_from_grid", property([](const Reaming& reaming) {
                               return matrix_of(reaming.bone_case().bone.grid.world_from_grid);
                             }))
      .def("surface", [](Simulation& self, int stride) {
        if (stride != 1 && stride != 2 && stride != 4)
          throw Error(ErrorKind::invalid_input, "stride must be 1, 2 or 4");
        const Simulation::Use use(self);
        TriangleMesh mesh;
        {
          const Computing computing;
          mesh = session::reamed_surface(self.reaming.bone_case(), stride);
        }
        return mesh_arrays(mesh);
      });
}

/// Of a camera in the plan frame; without a place it is in front of the glenoid.
py::tuple picture(Simulation& self, const std::optional<Triple>& eye_mm, const Triple& target_mm,
                  const std::optional<Triple>& up, double field_of_view_rad, int width, int height,
                  bool with_reamer) {
  std::optional<render::Camera> camera;
  if (eye_mm) {
    camera.emplace();
    camera->eye_mm = vector(*eye_mm);
    camera->target_mm = vector(target_mm);
    camera->up = up ? vector(*up) : Vec3::UnitY();
    camera->vertical_field_of_view_rad = field_of_view_rad;
  }
  const Simulation::Use use(self);
  VoxelPicture drawn;
  {
    const Computing computing;
    drawn = self.reaming.picture(camera, width, height, with_reamer);
  }
  const py::ssize_t rows = height, columns = width;
  return py::make_tuple(py::array_t<uint8_t>({rows, columns, py::ssize_t{3}}, drawn.rgb.data()),
                        py::array_t<float>({rows, columns}, drawn.depth_mm.data()),
                        py::array_t<uint8_t>({rows, columns}, drawn.labels.data()),
                        py::array_t<uint8_t>({rows, columns}, drawn.cut.data()).attr("view")("bool"));
}

void bind_moments(py::class_<Simulation>& simulation) {
  simulation
      .def("use_feed_model",
           [](Simulation& self, const py::object& model, const py::object& bone_type) {
             const Simulation::Use use(self);
             self.reaming.use(std::make_unique<OwnFeedModel>(model, bone_type));
           })
      .def("reset",
           [](Simulation& self) {
             const Simulation::Use use(self);
             const Computing computing;
             self.reaming.reset();
           })
      .def("snapshot",
           [](Simulation& self) {
             const Simulation::Use use(self);
             const Computing computing;
             return self.reaming.snapshot();
           })
      .def("restore", [](Simulation& self, const Snapshot& snapshot) {
        const Simulation::Use use(self);
        const Computing computing;
        self.reaming.restore(snapshot);
      });
}

void bind_told(py::class_<Simulation>& simulation) {
  simulation
      .def("metrics_json",
           [](Simulation& self) {
             const Simulation::Use use(self);
             const Computing computing;
             return self.reaming.metrics().dump();
           })
      .def("score_json",
           [](Simulation& self, const std::string& rubric) {
             const Simulation::Use use(self);
             const Computing computing;
             return self.reaming.score(rubric).dump();
           })
      .def("save",
           [](Simulation& self, const std::filesystem::path& folder, bool pictures) {
             const Simulation::Use use(self);
             Computing computing;
             Signals signals(computing);
             self.reaming.save(folder, pictures, signals.progress());
           })
      .def("picture", &picture)
      .def("plan_json",
           [](const Simulation& self) { return case_::to_json(self.reaming.model().plan).dump(); })
      .def("table",
           [](Simulation& self, const py::array& rows) {
             const Simulation::Use use(self);
             return trace_arrays(ticks_from(rows), self.reaming.bone_case().bone.grid,
                                 self.reaming.model().world_from_plan, 0);
           })
      .def_property_readonly("tick", property([](const Reaming& reaming) { return reaming.state().tick; }))
      .def_property_readonly("session_hash", property([](const Reaming& reaming) {
                               return to_hex(reaming.state().session_hash);
                             }))
      .def_property_readonly("backend",
                             property([](const Reaming& reaming) { return reaming.state().backend.name; }))
      .def_property_readonly("case", [](const Simulation& self) { return self.reaming.bone_case().id; })
      .def_property_readonly("reamer", [](const Simulation& self) { return self.reaming.model().tool.name; })
      .def_property_readonly("stiffness_n_mm",
                             [](const Simulation& self) {
                               const sim::Settings& settings = self.reaming.model().settings;
                               return settings.stiffness_n_mm * settings.force_scale;
                             })
      .def_property_readonly("script_s",
                             [](const Simulation& self) { return self.reaming.script().duration_s; });
}

}  // namespace

void bind_simulation(py::module_& module) {
  py::class_<Snapshot>(module, "Snapshot", "A moment of a Simulation, see Simulation.snapshot().")
      .def_property_readonly(
          "tick", [](const Snapshot& self) { return self.moment.tick; },
          "The number of ticks that had passed.")
      .def_property_readonly("bytes", &Snapshot::bytes, "The memory that it takes, about.");
  py::class_<Simulation> simulation(module, "Simulation");
  simulation
      .def(py::init([](const std::string& case_name, const std::string& script,
                       const std::optional<std::string>& script_json, const std::string& reamer,
                       const std::optional<std::array<double, 6>>& reamer_axis, double point_spacing_mm,
                       std::optional<double> force_scale, const std::string& feed_model,
                       const std::string& removal, const std::string& backend, uint64_t seed,
                       const std::optional<std::filesystem::path>& data) {
        session::RunRequest run;
        run.case_name = case_name;
        run.script_name = script;
        run.tool = reamer;
        run.tool_axis = axis_from(reamer_axis);
        run.tool_spacing_mm = point_spacing_mm;
        run.force_scale = force_scale;
        run.feed_model = feed_model;
        run.backend = backend;
        run.random_seed = seed;
        return make(std::move(run), script_json, removal, data);
      }))
      .def("step", &step)
      .def("run", &run)
      .def("run_script", &run_script);
  bind_moments(simulation);
  bind_told(simulation);
  bind_bone(simulation);
}

}  // namespace ream::python
