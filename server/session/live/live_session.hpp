#pragma once
#include <memory>
#include <mutex>

#include "device/crash_guard.hpp"
#include "session/live/session_follower.hpp"
#include "session/session_context.hpp"

namespace ream::session {

/// A live session as its commands see it: the haptic loop on its own thread, a follower on another, and the
/// state that the follower and the commands share.
class LiveSession final : public RunningSession {
 public:
  /// A new one. Errors: those of build_setup and Simulation.
  static std::unique_ptr<LiveSession> create(const SessionContext& context, const SessionRequest& request);
  /// Goes on with one that was interrupted or stopped, under the same id; see SessionEngine::resume. Errors:
  /// those of ResumePoint and Simulation.
  static std::unique_ptr<LiveSession> resume(const SessionContext& context, const SessionRequest& request,
                                             const std::string& reamer);
  ~LiveSession() override;

  void start() override;
  void pause() override { set_paused(true); }
  void unpause() override { set_paused(false); }
  void stop() override;
  bool stands_still() const override { return loop_.stood_still_ms() > 0 && !loop_.ended(); }
  bool relabel(const SessionRequest& request) override { return state_.relabel(request); }
  SessionStatus status() const override { return state_.status(); }
  nlohmann::json metrics() const override { return state_.metrics(); }
  Annotation annotate(const NewAnnotation& note) override;
  std::vector<Annotation> annotations() const override;
  void write_surface(const std::filesystem::path& ply, int stride) override;
  void write_picture(const std::filesystem::path& png) override;
  std::unique_ptr<net::WebSocketSession> subscribe(int stride) override;
  std::unique_ptr<net::WebSocketSession> connect_device() override;

 private:
  LiveSession(const SessionContext& context, const SessionRequest& request, SimulationSetup setup,
              std::unique_ptr<ResumePoint> from);
  std::unique_ptr<SessionFiles> open_files();
  void set_paused(bool paused);
  case_::Case intact_case() const;
  void publish_to_openigtlink() const;

  // In this order, as each uses those before it: the follower's thread ends first, then nobody watches the
  // device for crashes any more, then the loop is destroyed, which closes the device, and then what it ran
  // on.
  const SessionContext context_;
  const SessionRequest request_;
  std::unique_ptr<ResumePoint> from_;  ///< until started, where it goes on; holds the folder's lock till then
  Simulation simulation_;
  LoopRings rings_;
  const double warmup_us_;  ///< slow ticks of this session, before the first
  sim::HapticLoop loop_;
  const std::shared_ptr<device::DevicePort> device_port_;  ///< of devices that connect over the network
  const std::shared_ptr<stream::Fanout> fanout_;
  LiveState state_;
  std::mutex stopping_;  ///< one stop() at a time
  device::CrashWatch crash_watch_;
  SessionFollower follower_;
};

}  // namespace ream::session
