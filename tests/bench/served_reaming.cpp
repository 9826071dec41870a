#include "bench/served_reaming.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "access/secret.hpp"
#include "api/server.hpp"
#include "bench/many_sessions.hpp"
#include "bench/pecking.hpp"
#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "session/folder/session_folder.hpp"
#include "session/service/simulation_engine.hpp"
#include "store/database.hpp"
#include "support/memory_in_use.hpp"
#include "support/raw_http.hpp"
#include "support/temporary_folder.hpp"

namespace ream::bench {
using nlohmann::json;
namespace {

constexpr const char* script_name = "pecking";
constexpr double thesis_spacing_mm = 0.1;
constexpr int office_sessions = 10'000;
constexpr int most_refusals = 60;
constexpr double served_press_n = 52.0;

}  // namespace

struct ServedReaming::House {
  House(sim::Realtime realtime, double turn_s, Surroundings surroundings) {
    keep_thesis_case(folder.path());
    folder.write("scripts/" + std::string(script_name) + ".json", pecking(turn_s, served_press_n).dump());
    session::SessionContext context;
    context.data = folder.path();
    context.backend = "cpu";
    context.realtime = realtime;
    context.tool_spacing_mm = thesis_spacing_mm;
    api::ServerOptions options;
    options.listen.port = 0;
    options.cases_folder = cases_folder(context.data);
    options.sessions_folder = sessions_folder(context.data);
    options.sessions.kept = 1;  // each keeps its bone
    options.engine = std::make_shared<session::SimulationEngine>(context);
    if (surroundings == Surroundings::office) write_sessions(folder, office_sessions, "sessions/");
    options.database = std::make_shared<store::Database>("sqlite:" + (folder.path() / "ream.db").string());
    server = std::make_unique<api::Server>(std::move(options));
    server->start();
    if (surroundings == Surroundings::office) open_office();
  }

  /// From here on a token is needed. Waits until all sessions are listed.
  void open_office() {
    access::AccessControl& access_control = server->access_control();
    const access::User chief = access_control.users.add(
        {"chief", "", access::Role::operator_, access::Secret(std::string("a pass phrase of a bench"))});
    access::NewCredential wanted;
    wanted.user_id = chief.id;
    wanted.name = "bench";
    token = access_control.credentials.issue(access::CredentialKind::token, wanted).secret.reveal();
    while (ask("GET", "?limit=1").at("total") != office_sessions)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }

  json ask(const char* method, const std::string& path, const std::string& body = {}) const {
    const test::HttpReply reply = test::http_request(
        server->port(), method, "/api/v1/sessions" + path, body,
        token.empty() ? std::map<std::string, std::string>{}
                      : std::map<std::string, std::string>{{"Authorization", "Bearer " + token}});
    if (reply.status >= 300)
      throw Error(ErrorKind::unavailable, std::string(method) + " " + path + ": " + reply.body);
    return json::parse(reply.body);
  }

  test::TemporaryFolder folder;
  std::unique_ptr<api::Server> server;
  std::string token;  ///< empty where none is needed
};

ServedReaming::ServedReaming(sim::Realtime realtime, double turn_s, Surroundings surroundings)
    : house_(std::make_unique<House>(realtime, turn_s, surroundings)) {}

ServedReaming::~ServedReaming() = default;

ServedTurn ServedReaming::run(StreamViewer& viewer, const std::function<void(const Door&)>& beside) {
  ServedTurn turn;
  const std::string id =
      house_->ask("POST", "", json{{"case", thesis_case}, {"script", script_name}}.dump()).at("id");
  const Door door(house_->server->port(), id, house_->token);
  viewer.watch(door);
  house_->ask("POST", "/" + id + "/start");
  if (beside) beside(door);
  uint64_t missed = 0;
  for (json told; told.is_null() || told.at("state") == "running";) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    turn.peak_memory_mb =
        std::max(turn.peak_memory_mb, static_cast<double>(test::memory_in_use_kib()) / 1024.0);
    try {
      told = house_->ask("GET", "/" + id);
    } catch (const std::exception&) {
      if (++turn.refusals > most_refusals) throw;
      continue;
    }
    const uint64_t missed_so_far = told.at("loop").at("missed");
    turn.missed_in_second.push_back(missed_so_far - missed);
    missed = missed_so_far;
  }
  turn.streamed_mb = static_cast<double>(viewer.stop_watching()) * 1e-6;
  const session::SessionStatus status =
      session::read_session_folder(sessions_folder(house_->folder.path()) / id).status;
  if (status.state != SessionState::finished)
    throw Error(ErrorKind::unavailable,
                "the session ended as " + to_text(status.state) + ": " + status.fault);
  turn.loop = status.loop;
  turn.ticks = status.tick;
  return turn;
}

}  // namespace ream::bench
