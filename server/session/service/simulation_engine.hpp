#pragma once
#include "session/service/session_engine.hpp"
#include "session/session_context.hpp"

namespace ream::session {

/// The engine of `ream serve`: sessions, replays, scores and exports of one data folder.
class SimulationEngine final : public SessionEngine {
 public:
  explicit SimulationEngine(SessionContext context) : context_(std::move(context)) {}

  std::string program() const override;
  void make_demo_case() override;
  std::unique_ptr<RunningSession> make(const SessionRequest& request) override;
  std::unique_ptr<RunningSession> resume(const SessionRequest& request, const std::string& reamer) override;
  std::unique_ptr<RunningReplay> replay(const ReplayRequest& request) override;
  std::unique_ptr<SessionMeasurer> measurer() const override;
  void write_deviations(const std::filesystem::path& folder, const std::filesystem::path& json,
                        const Progress& progress) const override;
  void check_export(const ExportFormat& format, const ExportOrder& order) const override;
  void write_export(const ExportFormat& format, const ExportOrder& order, const std::filesystem::path& out,
                    const Progress& progress) const override;

 private:
  const SessionContext context_;
};

}  // namespace ream::session
