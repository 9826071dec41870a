#include "api/study_dependencies.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/text.hpp"
#include "workup/case_json.hpp"

namespace ream::api {
namespace {

class ServerDependencies final : public study::StudyDependencies {
 public:
  ServerDependencies(std::filesystem::path cases_folder, session::SessionService& sessions,
                     access::AccessControl& access_control)
      : cases_folder_(std::move(cases_folder)), sessions_(sessions), access_control_(access_control) {}

  std::optional<study::StudyUser> find_user(const std::string& user_id) const override {
    try {
      const access::User user = access_control_.users.get(user_id);
      return study::StudyUser{user.display_name.empty() ? user.name : user.display_name, to_text(user.role)};
    } catch (const Error& unknown) {
      if (unknown.kind() != ErrorKind::not_found) throw;
      return std::nullopt;
    }
  }

  bool has_case(const std::string& case_id) const override {
    return is_name(case_id) && workup::is_case_folder(cases_folder_ / case_id);
  }

  std::vector<session::SessionRecord> sessions(const std::string& study_id) const override {
    store::SessionQuery query;
    query.study = study_id;
    query.limit = SIZE_MAX;
    std::vector<session::SessionRecord> all = sessions_.list(query).sessions;
    std::erase_if(all, [](const auto& one) { return is_live(one.status.state) || one.status.tick == 0; });
    return all;
  }

  bool has_live_session(const std::string& study_id, const std::string& code) const override {
    store::SessionQuery query;
    query.study = study_id;
    query.participant = code;
    query.limit = SIZE_MAX;
    const std::vector<session::SessionRecord> all = sessions_.list(query).sessions;
    return std::any_of(all.begin(), all.end(), [](const auto& one) { return is_live(one.status.state); });
  }

  nlohmann::json metrics(const std::string& session_id) const override {
    try {
      return sessions_.metrics(session_id);
    } catch (const Error& missing) {
      if (missing.kind() != ErrorKind::not_found) throw;
      return nlohmann::json::object();
    }
  }

 private:
  const std::filesystem::path cases_folder_;
  session::SessionService& sessions_;
  access::AccessControl& access_control_;
};

}  // namespace

std::shared_ptr<const study::StudyDependencies> study_dependencies(const std::filesystem::path& cases_folder,
                                                                   session::SessionService& sessions,
                                                                   access::AccessControl& access_control) {
  return std::make_shared<const ServerDependencies>(cases_folder, sessions, access_control);
}

}  // namespace ream::api
