#include "session/service/simulation_engine.hpp"

#include "core/data_folder.hpp"
#include "core/log.hpp"
#include "core/version.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "score/rubric_store.hpp"
#include "session/export/export_formats.hpp"
#include "session/folder/session_folder.hpp"
#include "session/live/live_session.hpp"
#include "session/replay/replay_session.hpp"
#include "session/scoring/rescoring.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;

class RecordingMeasurer final : public SessionMeasurer {
 public:
  explicit RecordingMeasurer(const fs::path& data) : rescorer_(data) {}
  nlohmann::json metrics(const fs::path& folder, const Progress& progress) override {
    const record::Recording recording(recording_file(folder), record::Recording::Trust::checked);
    if (const std::string& damage = recording.log().damage(); !damage.empty()) log::warn(damage);
    return rescorer_.metrics(recording, progress);
  }

 private:
  Rescorer rescorer_;
};

/// What an order asks for; everything in it goes by ids.
ExportRequest export_request_of(const ExportFormat& format, const ExportOrder& order,
                                const SessionContext& context) {
  const fs::path& data = context.data;
  ExportRequest request;
  request.page = context.page;
  request.recording = recording_file(sessions_folder(data) / order.session.id);
  request.data = data;
  request.part = order.part;
  request.labels = order.session;
  if (format.kind != ExportKind::report) return request;
  request.rubric = score::RubricStore(rubrics_folder(data)).find(order.rubric);
  request.component_load = order.component_load;
  if (!order.benchmark.empty())
    request.benchmark = score::load_benchmark(benchmarks_folder(data) / (order.benchmark + ".json"));
  return request;
}

}  // namespace

std::string SimulationEngine::program() const { return version_text(); }

void SimulationEngine::make_demo_case() { ct::load_or_make_demo_case(context_.data); }

std::unique_ptr<RunningSession> SimulationEngine::make(const SessionRequest& request) {
  return LiveSession::create(context_, request);
}

std::unique_ptr<RunningSession> SimulationEngine::resume(const SessionRequest& request,
                                                         const std::string& reamer) {
  return LiveSession::resume(context_, request, reamer);
}

std::unique_ptr<RunningReplay> SimulationEngine::replay(const ReplayRequest& request) {
  return std::make_unique<ReplaySession>(context_, request);
}

std::unique_ptr<SessionMeasurer> SimulationEngine::measurer() const {
  return std::make_unique<RecordingMeasurer>(context_.data);
}

void SimulationEngine::write_deviations(const fs::path& folder, const fs::path& target,
                                        const Progress& progress) const {
  ExportRequest request;
  request.recording = recording_file(folder);
  request.data = context_.data;
  session::write_deviations(request, target, progress);
}

void SimulationEngine::check_export(const ExportFormat& format, const ExportOrder& order) const {
  export_request_of(format, order, context_);
}

void SimulationEngine::write_export(const ExportFormat& format, const ExportOrder& order, const fs::path& out,
                                    const Progress& progress) const {
  format.write(export_request_of(format, order, context_), out, progress);
}

}  // namespace ream::session
