#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/session_state.hpp"
#include "net/websocket.hpp"
#include "session/annotation.hpp"
#include "sim/loop_health.hpp"

namespace ream::session {

/// What somebody asked for. Names are plain ids ([a-z0-9-]), never paths.
struct SessionRequest {
  std::string id;  ///< given by the server
  std::string case_id, script;
  std::optional<double> force_scale;   ///< simulated N per hand N; none: the script's
  bool at_most_scripts_scale = false;  ///< more than the script's force_scale is refused
  std::string device = "script";       ///< name in the registry of devices: script, network, browser, ...
  std::string device_profile = {};     ///< what it can render; empty: the script's
  std::string created_utc = {};        ///< "2025-03-01T12:00:00.250Z", given by the server
  std::string trainee_id = {};         ///< user who trains; empty without users
  std::string trainee = {};            ///< the same for people
  std::string study = {};              ///< id of the study that it belongs to; empty: none
  std::string participant = {};        ///< code under which the study knows the trainee
  std::string phase = {};        ///< what it is for in the study's design (study_design.hpp); may be empty
  std::string title = {};        ///< what people call it; may be empty
  std::string reset_of = {};     ///< session that this one is another attempt of; empty: none
  int attempt = 1;               ///< 2 after the first reset, and so on
  std::string followed_by = {};  ///< session that went on from intact bone; empty: none
  bool keep = false;             ///< never deleted by the rules of retention
  bool theatre = false;          ///< nothing but the bone is shown while reaming
};

/// How the session's device is doing.
struct DeviceLinkStatus {
  std::string name;              ///< as asked for
  std::string profile;           ///< what it can render (device/profiles.hpp)
  std::string state;             ///< fresh, held, fading or lost; empty before the first tick
  std::optional<double> rtt_ms;  ///< of devices that are reached over a network, once it is known
  /// Messages: taken, missing in their numbering, come too late to be used, refused as senseless.
  uint64_t received = 0, missing = 0, late = 0, refused = 0;
};

struct SessionStatus {
  SessionState state = SessionState::created;
  uint32_t tick = 0;
  double duration_s = 0.0;
  double force_scale = 1.0;
  /// Words for people: why state is fault or interrupted, or what keeps a live session from going on now (its
  /// device is lost); else empty.
  std::string fault;
  bool held = false;     ///< paused by pause(), whatever its device says
  sim::LoopHealth loop;  ///< since the session began
  DeviceLinkStatus device;
};

/// One training session, ready for its first tick: what the server asks of it. Called from several worker
/// threads at once, so every function is safe against the others; none may wait for a viewer. Destroying it
/// stops it.
class RunningSession {
 public:
  virtual ~RunningSession() = default;

  /// Only in state created; the service has checked. Throws Error when it cannot start.
  virtual void start() = 0;
  /// Takes the force away as the device's own pause button does, from a tick on that is recorded with it, and
  /// returns when that tick has been. Only while it runs or is paused by its device; the service has checked.
  virtual void pause() = 0;
  /// Goes on after pause(), where the device lets it. Only while it is held.
  virtual void unpause() = 0;
  /// Ends it and waits for the loop (zero force on the way out). Harmless when it has ended already.
  virtual void stop() = 0;

  /// Its loop stands still in its device: to destroy it would wait for that, and end the process where it
  /// does not come back.
  virtual bool stands_still() const = 0;

  virtual SessionStatus status() const = 0;
  /// Its labels are now those of `request`; false when it has ended or was never started, so that nothing of
  /// it writes them down any more.
  virtual bool relabel(const SessionRequest& request) = 0;
  /// The keys of metrics.json; grid_hash is null until the end.
  virtual nlohmann::json metrics() const = 0;

  /// Puts a remark into the recording while it is being written. Error conflict when it is not: before the
  /// start, and from the end on.
  virtual Annotation annotate(const NewAnnotation& note) = 0;
  /// All of the recording so far.
  virtual std::vector<Annotation> annotations() const = 0;

  /// Writes the surface of what remains of the bone now, as PLY in the world frame, with one sample every
  /// `stride` (1, 2 or 4) voxels; or a picture of it, as PNG. Takes seconds of the caller's thread. Error io.
  virtual void write_surface(const std::filesystem::path& ply, int stride) = 0;
  virtual void write_picture(const std::filesystem::path& png) = 0;

  /// A viewer joins: Hello first, then the whole surface, then what changes, with one sample every `stride`
  /// (1, 2 or 4) voxels. It may outlive stop(), not the session.
  virtual std::unique_ptr<net::WebSocketSession> subscribe(int stride) = 0;

  /// The session's device takes its place (proto/device.fbs), and that of one that was there before. It may
  /// outlive stop(), not the session. Error conflict when the session's device is none that connects itself.
  virtual std::unique_ptr<net::WebSocketSession> connect_device() = 0;
};

}  // namespace ream::session
