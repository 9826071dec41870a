#include "session/live/live_session.hpp"

#include <cmath>

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "geometry/mesh_io.hpp"
#include "session/annotation.hpp"
#include "session/live/stream_messages.hpp"
#include "session/live/viewer_stream.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/reamed_pictures.hpp"
#include "session/simulation/session_setup.hpp"
#include "sim/tick_trial.hpp"

namespace ream::session {
namespace {

RunRequest run_request(const SessionContext& context, const SessionRequest& request) {
  RunRequest run;
  run.case_name = request.case_id;
  const bool built_in = request.script == "demo" || request.script == "practice";
  run.script_name =
      built_in ? request.script : (context.data / "scripts" / (request.script + ".json")).string();
  if (!built_in && !std::filesystem::exists(run.script_name))
    throw Error(ErrorKind::not_found, "no script '" + request.script + "' in the server's folder scripts");
  run.backend = context.backend;
  run.tool_spacing_mm = context.tool_spacing_mm;
  run.force_scale = request.force_scale;
  run.at_most_scripts_scale = request.at_most_scripts_scale;
  run.device = request.device;
  run.device_profile = request.device_profile;
  return run;
}

score::MetricsAccumulator metrics_so_far(const Simulation& simulation, const ResumePoint* from) {
  if (from) return from->metrics();
  return {simulation.bone_case.bone.grid.voxel_volume_mm3(), simulation.model.world_from_plan.inverse()};
}

SessionStatus first_status(const SessionRequest& request, const Simulation& simulation,
                           const ResumePoint* from) {
  SessionStatus status;
  status.device.name = request.device;
  status.device.profile = simulation.device->traits().profile;
  status.force_scale = simulation.model.settings.force_scale;
  if (from) status.tick = from->ticks();
  return status;
}

std::shared_ptr<device::DevicePort> make_device_port(const SessionRequest& request,
                                                     const Simulation& simulation) {
  if (!simulation.link) return nullptr;
  const auto kind = request.device == "browser" ? device::RemoteKind::steering : device::RemoteKind::handle;
  return std::make_shared<device::DevicePort>(
      simulation.link, kind,
      device::DeviceWelcome{request.id, request.device, simulation.model.settings.limits.force_max_n,
                            simulation.device->traits().stale});
}

/// With the message that each viewer gets first.
std::shared_ptr<stream::Fanout> make_fanout(const SessionContext& context, const SessionRequest& request,
                                            const Simulation& simulation) {
  const sim::Model& model = simulation.model;
  stream::HelloInfo info = make_hello(simulation.bone_case, model.plan, model.tool, simulation.anatomy);
  info.session_id = request.id;
  info.server_epoch = context.server_epoch;
  info.force_scale = model.settings.force_scale;
  info.force_max_n = model.settings.limits.force_max_n;
  auto fanout = std::make_shared<stream::Fanout>();
  fanout->publish_hello(stream::hello_message(info));
  return fanout;
}

}  // namespace

std::unique_ptr<LiveSession> LiveSession::create(const SessionContext& context,
                                                 const SessionRequest& request) {
  SimulationSetup setup = build_setup(run_request(context, request), context.data);
  return std::unique_ptr<LiveSession>(new LiveSession(context, request, std::move(setup), nullptr));
}

std::unique_ptr<LiveSession> LiveSession::resume(const SessionContext& context, const SessionRequest& request,
                                                 const std::string& reamer) {
  auto from = std::make_unique<ResumePoint>(sessions_folder(context.data) / request.id, context.data);
  SimulationSetup setup = from->setup(run_request(context, request), reamer);
  return std::unique_ptr<LiveSession>(new LiveSession(context, request, std::move(setup), std::move(from)));
}

LiveSession::LiveSession(const SessionContext& context, const SessionRequest& request, SimulationSetup setup,
                         std::unique_ptr<ResumePoint> from)
    : context_(context),
      request_(request),
      from_(std::move(from)),
      simulation_(std::move(setup)),
      rings_(simulation_.bone_case.bone.grid),
      warmup_us_(sim::rehearsed_tick_us(simulation_.model, simulation_.state)),
      loop_(simulation_.model, simulation_.state, *simulation_.device, rings_.reports,
            {true, context.realtime, -1, context.guard_now_ns}),
      device_port_(make_device_port(request, simulation_)),
      fanout_(make_fanout(context, request, simulation_)),
      state_(request, first_status(request, simulation_, from_.get()),
             from_ ? from_->recording().annotations() : std::vector<record::ops::Annotation>()),
      crash_watch_(*simulation_.device),
      follower_(simulation_, rings_, loop_, device_port_.get(), *fanout_, state_,
                metrics_so_far(simulation_, from_.get()), from_ ? &from_->start_coverage() : nullptr) {
  simulation_.state.brick_sender = &rings_.sender;
  if (!crash_watch_.is_watched())
    log::warn("session " + request_.id +
              ": a crash of the server would leave its device to its own watchdog");
  const sim::Backend& backend = simulation_.state.backend;
  log::info("session " + request_.id + ": contact and removal on " + backend.name +
            (backend.choice.empty() ? "" : " (" + backend.choice + ")") + ", slow ticks take " +
            std::to_string(std::lround(warmup_us_)) + " us");
}

LiveSession::~LiveSession() { stop(); }

/// Where it cannot, nothing is left of a new session's folder, and one that was to go on can be resumed
/// again.
std::unique_ptr<SessionFiles> LiveSession::open_files() {
  try {
    return SessionFiles::open(simulation_, context_.data, state_.labels(), follower_.coverage(), from_.get());
  } catch (const std::exception& e) {
    std::error_code ignored;
    if (!from_) std::filesystem::remove_all(sessions_folder(context_.data) / request_.id, ignored);
    from_.reset();
    state_.refuse_start(e.what());
    throw;
  }
}

void LiveSession::start() {
  if (status().state != SessionState::created)
    throw Error(ErrorKind::conflict, "session " + request_.id + " has been started already");
  auto cpu_reservation = context_.cpus->reserve(request_.id, warmup_us_);
  loop_.pin_to(cpu_reservation->cpu());
  const SessionState state_before = from_ ? from_->state() : SessionState::fault;
  std::unique_ptr<SessionFiles> files = open_files();
  follower_.begin(std::move(files), std::move(cpu_reservation));
  from_.reset();
  try {
    loop_.start();
    publish_to_openigtlink();
  } catch (const std::exception& e) {
    state_.fail_start(state_before, e.what());
    throw;
  }
}

void LiveSession::set_paused(bool paused) {
  loop_.pause(paused);
  state_.wait_until_held(paused);
}

void LiveSession::stop() {
  const std::lock_guard one_at_a_time(stopping_);
  loop_.stop();
  state_.stop();
}

Annotation LiveSession::annotate(const NewAnnotation& note) { return annotation_of(state_.annotate(note)); }

std::vector<Annotation> LiveSession::annotations() const {
  std::vector<Annotation> annotations;
  for (const record::ops::Annotation& op : state_.annotations()) annotations.push_back(annotation_of(op));
  return annotations;
}

/// The haptic thread writes the session's own bone, so the case is loaded once more.
case_::Case LiveSession::intact_case() const {
  case_::Case intact = find_case(request_.case_id, context_.data);
  intact.plan = simulation_.model.plan;
  case_::cut_pilot_hole(intact.bone, *intact.plan);
  return intact;
}

void LiveSession::write_surface(const std::filesystem::path& ply, int stride) {
  case_::Case reamed = intact_case();
  reamed.bone.coverage = state_.coverage();
  write_ply(ply, reamed_surface(reamed, stride), case_::frame_in_words(reamed.side));
}

void LiveSession::write_picture(const std::filesystem::path& png) {
  case_::Case reamed = intact_case();
  std::vector<uint8_t> before = state_.coverage();
  before.swap(reamed.bone.coverage);
  session::write_picture(reamed, before, png, case_surroundings(request_.case_id, context_.data));
}

void LiveSession::publish_to_openigtlink() const {
  if (!context_.openigtlink_session) return;
  const case_::Case& c = simulation_.bone_case;
  const std::string words = (c.name.empty() ? c.id : c.name) + ", " + case_::to_text(c.side) + ", reamer " +
                            simulation_.model.tool.name;
  context_.openigtlink_session->set(std::make_shared<const openigtlink::SessionView>(
      openigtlink::SessionView{request_.id, words, c.bone.grid, simulation_.model.tool.mesh, fanout_}));
}

std::unique_ptr<net::WebSocketSession> LiveSession::subscribe(int stride) {
  return viewer_stream(fanout_, stride);
}

std::unique_ptr<net::WebSocketSession> LiveSession::connect_device() {
  if (device_port_) return device_port_->connect();
  throw Error(ErrorKind::conflict,
              "session '" + request_.id + "' has the device '" + request_.device +
                  "', which does not connect itself; a session with the device 'browser' "
                  "or 'network' waits for a client");
}

}  // namespace ream::session
