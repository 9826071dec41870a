#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "api/server.hpp"
#include "bench/bench.hpp"
#include "bench/many_sessions.hpp"
#include "core/clock.hpp"
#include "core/error.hpp"
#include "store/session_index.hpp"
#include "support/fake_engine.hpp"
#include "support/postgres_server.hpp"
#include "support/raw_http.hpp"
#include "support/temporary_folder.hpp"

namespace ream::bench {
namespace {

using nlohmann::json;

constexpr int session_count = 10'000, store_rounds = 40;
constexpr size_t page_rows = 50;
constexpr double p95_goal_ms = 50.0;

/// One way to ask, as parameters of the REST route.
using Question = std::vector<std::pair<std::string, std::string>>;

const std::vector<Question>& lists() {
  static const std::vector<Question> all{{},
                                         {{"sort", "created_utc"}},
                                         {{"sort", "-duration_s"}},
                                         {{"sort", "trainee"}},
                                         {{"sort", "case"}},
                                         {{"sort", "-state"}}};
  return all;
}

const std::vector<Question>& filters() {
  static const std::vector<Question> all{
      {{"state", "fault,interrupted"}},
      {{"trainee", "u17"}},
      {{"case", "shoulder-7"}, {"sort", "-duration_s"}},
      {{"study", "pilot"}, {"participant", "P-3"}},
      {{"from", "2024-06-01"}, {"to", "2024-09-01"}, {"state", "finished"}},
      {{"q", "NUMBER 42"}},
      {{"q", "second try"}, {"sort", "trainee"}}};
  return all;
}

std::string value_of(const Question& question, const std::string& name) {
  for (const auto& [key, value] : question)
    if (key == name) return value;
  return {};
}

store::SessionQuery query_of(const Question& question) {
  store::SessionQuery query;
  const std::string states = value_of(question, "state");
  if (const size_t comma = states.find(','); !states.empty()) {
    query.states.push_back(states.substr(0, comma));
    if (comma != std::string::npos) query.states.push_back(states.substr(comma + 1));
  }
  query.trainee_id = value_of(question, "trainee");
  query.case_id = value_of(question, "case");
  query.study = value_of(question, "study");
  query.participant = value_of(question, "participant");
  query.created_from = value_of(question, "from");
  query.created_before = value_of(question, "to");
  query.text = value_of(question, "q");
  if (const std::string sort = value_of(question, "sort"); !sort.empty()) {
    query.descending = sort.front() == '-';
    query.order = store::session_order_from(query.descending ? sort.substr(1) : sort).value();
  }
  query.limit = page_rows;
  return query;
}

std::string path_of(const Question& question, const std::string& cursor) {
  std::string path = "/api/v1/sessions?limit=" + std::to_string(page_rows);
  for (const auto& [key, value] : question) {
    path += "&" + key + "=";
    for (const char c : value) path += c == ' ' ? "%20" : std::string(1, c);
  }
  return cursor.empty() ? path : path + "&cursor=" + cursor;
}

/// A page: how long it took to come, and the cursor of the next one.
struct Answer {
  double ms = 0.0;
  std::string next;
};
using Ask = std::function<Answer(const Question&, const std::string& cursor)>;

/// The first page of each question and the one behind it, again and again; times in ms, sorted.
std::vector<double> measure(const std::vector<Question>& questions, const Ask& ask) {
  std::vector<double> times_ms;
  for (int round = 0; round < store_rounds + 2; ++round)
    for (const Question& question : questions) {
      std::string cursor;
      for (int page = 0; page < 2; ++page) {
        Answer answer = ask(question, cursor);
        cursor = std::move(answer.next);
        if (round >= 2) times_ms.push_back(answer.ms);
        if (cursor.empty()) break;
      }
    }
  std::sort(times_ms.begin(), times_ms.end());
  return times_ms;
}

double percentile(const std::vector<double>& sorted, double fraction) {
  return sorted[static_cast<size_t>(std::lround(fraction * static_cast<double>(sorted.size() - 1)))];
}

void add_rows(const std::string& name, const Ask& ask, std::vector<Row>& rows) {
  for (const auto& [kind, questions] : {std::pair{"list", &lists()}, std::pair{"filter", &filters()}}) {
    const auto times_ms = measure(*questions, ask);
    rows.push_back({"store", name + kind + " p50", percentile(times_ms, 0.5), 0.0, "ms"});
    rows.push_back({"store", name + kind + " p95", percentile(times_ms, 0.95), 0.0, "ms", p95_goal_ms});
  }
}

Ask from_repository(store::Database& database) {
  return [&database](const Question& question, const std::string& cursor) {
    store::SessionQuery query = query_of(question);
    query.cursor = cursor;
    const auto start = SteadyClock::now();
    const auto found = store::SessionIndex(database).find(query);
    const double ms = elapsed_us(start) * 1e-3;
    if (found.rows.empty() || found.total > session_count)
      throw Error(ErrorKind::io, "the index answers nonsense");
    return Answer{ms, found.rows.size() > page_rows ? store::cursor_behind(query, found.rows[page_rows - 1])
                                                    : std::string()};
  };
}

Ask from_server(uint16_t port) {
  return [port](const Question& question, const std::string& cursor) {
    const auto start = SteadyClock::now();
    const test::HttpReply reply = test::http_request(port, "GET", path_of(question, cursor));
    const double ms = elapsed_us(start) * 1e-3;
    if (reply.status != 200) throw Error(ErrorKind::io, "the server answers " + reply.body);
    const json page = json::parse(reply.body);
    if (page.at("sessions").empty()) throw Error(ErrorKind::io, "the server lists nothing");
    return Answer{ms, page.at("next").is_null() ? std::string() : page.at("next").get<std::string>()};
  };
}

/// Seconds until a fresh server tells of all sessions.
double seconds_to_first_list(api::Server& server) {
  const auto start = SteadyClock::now();
  server.start();
  for (;;) {
    const test::HttpReply reply = test::http_request(server.port(), "GET", "/api/v1/sessions?limit=1");
    if (reply.status == 200 && json::parse(reply.body).at("total") == session_count)
      return elapsed_us(start) * 1e-6;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

std::unique_ptr<api::Server> server_on(const test::TemporaryFolder& sessions,
                                       std::shared_ptr<store::Database> database) {
  api::ServerOptions options;
  options.listen.port = 0;
  options.sessions_folder = sessions.path();
  options.database = std::move(database);
  options.engine = std::make_shared<test::FakeEngine>();
  return std::make_unique<api::Server>(std::move(options));
}

void measure_store(const std::string& name, const std::string& url, const test::TemporaryFolder& sessions,
                   std::vector<Row>& rows) {
  const auto database = std::make_shared<store::Database>(url);
  const std::string title = std::to_string(session_count) + " sessions, " + name + ", ";
  rows.push_back({"store", title + "first start until all are listed",
                  seconds_to_first_list(*server_on(sessions, database)), 0.0, "s"});
  const auto server = server_on(sessions, database);
  rows.push_back(
      {"store", title + "later start until all are listed", seconds_to_first_list(*server), 0.0, "s"});
  add_rows(title + "HTTP, ", from_server(server->port()), rows);
  add_rows(title + "repository, ", from_repository(*database), rows);
}

}  // namespace

std::vector<Row> store_suite(const Options&) {
  const test::TemporaryFolder sessions, files;
  write_sessions(sessions, session_count);
  std::vector<Row> rows;
  measure_store("SQLite", "sqlite:" + (files.path() / "ream.db").string(), sessions, rows);
  measure_store("PostgreSQL", test::PostgresServer::shared().make_database(), sessions, rows);
  return rows;
}

}  // namespace ream::bench
