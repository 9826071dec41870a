#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/print_score.hpp"
#include "app/cli/terminal_progress.hpp"
#include "app/open_database.hpp"
#include "app/plugin_option.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/interrupt.hpp"
#include "core/log.hpp"
#include "core/version.hpp"
#include "score/plugin_score.hpp"
#include "score/rubric_store.hpp"
#include "session/export/session_report.hpp"
#include "session/folder/session_folder.hpp"
#include "session/scoring/ended_sessions.hpp"
#include "session/scoring/rescoring.hpp"
#include "session/scoring/score_document.hpp"
#include "session/scoring/score_table.hpp"
#include "session/simulation/recorded_session.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

struct ScoreOptions {
  std::vector<std::string> sessions;
  bool all = false, save = false;
  std::string rubric = "standard", case_name, trainee, benchmark;
  fs::path csv;
  std::vector<fs::path> plugins;
  score::CusumParameters cusum;
};

/// A session that could be scored.
struct Judged {
  session::EndedSession table;
  nlohmann::json document;
};

session::Judge judge_of(const ScoreOptions& options, const fs::path& data) {
  session::Judge judge{score::find_rubric(options.rubric, score::RubricStore(rubrics_folder(data))), ""};
  if (!options.benchmark.empty())
    judge.benchmark = std::make_shared<const score::Benchmark>(score::load_benchmark(options.benchmark));
  return judge;
}

std::vector<std::string> names_of(const ScoreOptions& options, const fs::path& data) {
  const int ways =
      (options.sessions.empty() ? 0 : 1) + (options.all ? 1 : 0) + (options.trainee.empty() ? 0 : 1);
  if (ways != 1) throw Error(ErrorKind::usage, "name sessions, or say --all, or --trainee: one of these");
  if (options.all) return session::recorded_sessions(data);
  if (options.trainee.empty()) return options.sessions;
  std::vector<std::string> names;
  for (const session::EndedSession& session :
       session::sessions_of_trainee(session::ended_sessions(data), options.trainee))
    names.push_back(session.id);
  if (names.empty())
    throw Error(ErrorKind::not_found,
                "no session of a trainee '" + options.trainee + "' in " + sessions_folder(data).string());
  return names;
}

std::vector<session::Rescored> rescored(const ScoreOptions& options, const GlobalOptions& global,
                                        const fs::path& data) {
  const std::vector<std::string> names = names_of(options, data);
  catch_interrupts();
  note_reading(global.db, data, options.save ? "session.score" : "session.score.read", names);
  note_reading(global.db, data, "case.read", {options.case_name});
  const TerminalProgress progress;
  return session::rescore(names, options.case_name, data, std::cref(progress));
}

Judged judged(const session::Rescored& one, const ScoreOptions& options, const session::Judge& judge,
              const fs::path& data) {
  const fs::path recording = session::recording_path(one.name, data);
  Judged result;
  result.table = {one.name, session::description_of(record::Recording(recording)), one.metrics};
  result.document = session::score_document(version_text(), result.table.session, one.metrics, judge);
  if (const fs::path before = session::score_json(recording.parent_path());
      options.save && fs::exists(before))
    score::require_same_plugin(read_json_file(before));
  if (options.save) write_json_file(session::score_json(recording.parent_path()), result.document);
  return result;
}

void write_table(const std::vector<Judged>& all, const score::Rubric& rubric, const fs::path& csv) {
  std::vector<session::EndedSession> sessions;
  for (const Judged& one : all) sessions.push_back(one.table);
  const session::ExportTable table = session::score_table(sessions, rubric);
  fs::path codebook = csv;
  codebook.replace_filename(csv.stem().string() + "-codebook.csv");
  write_file_atomically(codebook, session::csv_of(session::score_codebook(table)));
  write_file_atomically(csv, session::csv_of(table));
}

nlohmann::json answer_of(const Judged& one) {
  nlohmann::json answer = one.document;
  answer["session"] = one.table.id;
  return answer;
}

nlohmann::json learning_of_all(const std::vector<Judged>& all, const session::Judge& judge,
                               const ScoreOptions& options) {
  std::vector<score::LearningPoint> points;
  for (const Judged& one : all)
    if (session::is_attempt(one.table))
      points.push_back(
          session::learning_point(one.table, score::apply_rubric(judge.rubric, one.table.metrics)));
  return score::learning_json(score::learning_curve(options.cusum, std::move(points)));
}

void print_all(const std::vector<Judged>& all, const nlohmann::json& failed, const nlohmann::json& learning,
               const ScoreOptions& options, bool as_json) {
  if (!as_json) {
    for (const Judged& one : all) print_score(one.table.id, one.document);
    if (!learning.is_null()) print_learning(options.trainee, learning);
    return;
  }
  nlohmann::json answers = failed;
  for (const Judged& one : all) answers.push_back(answer_of(one));
  if (!learning.is_null())
    std::cout << nlohmann::json{{"sessions", answers}, {"learning", learning}}.dump() << '\n';
  else
    std::cout << (answers.size() == 1 && !options.all ? answers.front() : answers).dump() << '\n';
}

void score_sessions(const ScoreOptions& options, const GlobalOptions& global) {
  const fs::path data = data_folder(global.data);
  const session::Judge judge = judge_of(options, data);
  const std::vector<session::Rescored> scored = rescored(options, global, data);
  std::vector<Judged> all;
  nlohmann::json failed = nlohmann::json::array();
  for (const session::Rescored& one : scored) {
    if (one.error.empty()) {
      all.push_back(judged(one, options, judge, data));
      continue;
    }
    if (scored.size() == 1) throw Error(one.kind, one.error);
    log::error(one.name + ": " + one.error);
    failed.push_back({{"session", one.name}, {"error", one.error}});
  }
  const nlohmann::json learning =
      options.trainee.empty() ? nlohmann::json() : learning_of_all(all, judge, options);
  if (!options.csv.empty()) write_table(all, judge.rubric, options.csv);
  print_all(all, failed, learning, options, global.json);
  if (!failed.empty())
    throw Error(ErrorKind::invalid_input, std::to_string(failed.size()) + " of " +
                                              std::to_string(scored.size()) +
                                              " sessions could not be scored; the lines above say why");
}

}  // namespace

void add_score_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<ScoreOptions>();
  CLI::App* command =
      app.add_subcommand("score", "Compute the metrics of recorded sessions anew and judge them");
  command->add_option("SESSION", options->sessions,
                      "Id of the data folder, a folder with recording.ream, or such a file; one or more");
  command->add_flag("--all", options->all, "All sessions of the data folder");
  command->add_option(
      "--trainee", options->trainee,
      "All sessions of a trainee (user id, code or name), and the course of learning (CUSUM)");
  command->add_option("--case", options->case_name,
                      "Where the case is, if not under the name that the recording gives");
  command->add_option(
      "--rubric", options->rubric,
      "Judge by it: id or id@version of the data folder's rubrics, or a file (proto/rubric.schema.json)");
  command->add_option("--benchmark", options->benchmark, "Compare with experts: file of ream benchmark");
  command->add_flag("--save", options->save, "Write score.json into each session's folder");
  command->add_option("--csv", options->csv,
                      "FILE.csv: one row a session; FILE-codebook.csv says what columns mean");
  command->add_option("--acceptable-rate", options->cusum.acceptable_rate,
                      "CUSUM: share of failures of the proficient, 0.2 by default");
  command->add_option("--unacceptable-rate", options->cusum.unacceptable_rate,
                      "CUSUM: of the others, 0.4 by default");
  command->add_option("--alpha", options->cusum.alpha,
                      "CUSUM: chance of calling the proficient not so, 0.1 by default");
  command->add_option("--beta", options->cusum.beta,
                      "CUSUM: chance of calling the others proficient, 0.1 by default");
  add_plugin_option(*command, options->plugins);
  command->callback([options, &global] {
    use_plugins(options->plugins);
    score_sessions(*options, global);
  });
}

}  // namespace ream::app
