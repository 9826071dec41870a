#include "session/export/session_facts.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/log.hpp"
#include "core/version.hpp"
#include "report/number_text.hpp"

namespace ream::session {
namespace {

using nlohmann::json;

std::string text(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

json parsed_or_empty(const std::string& words) {
  json value = json::parse(words, nullptr, false);
  return value.is_object() ? value : json::object();
}

std::string guide_in_words(const json& session) {
  const auto guide = session.find("guide");
  const std::string kind = guide != session.end() && guide->is_object() ? text(*guide, "kind") : "";
  if (kind == "nipple") return "nipple in the pilot hole";
  if (kind == "pin") return "guide pin";
  return kind == "none" ? "none" : "";
}

std::string device_in_words(const std::string& device) {
  if (device.empty() || device == "script") return "a script";
  if (device == "browser") return "the page";
  return device == "network" ? "a device on the network" : device;
}

}  // namespace

json description_of(const record::Recording& recording) {
  json session = parsed_or_empty(recording.header().description);
  const std::filesystem::path beside = recording.log().path().parent_path() / "session.json";
  std::error_code failed;
  if (std::filesystem::exists(beside, failed)) try {
      session.update(read_json_file(beside));
    } catch (const Error& e) {
      log::warn(e.what());
    }
  return session;
}

report::SessionFacts session_facts(const record::Recording& recording, const json& session,
                                   const json& metrics) {
  const record::ops::Header& header = recording.header();
  report::SessionFacts facts;
  facts.id = text(session, "id");
  facts.case_name = text(session, "case_name");
  if (facts.case_name.empty()) facts.case_name = header.case_id;
  facts.side = text(session, "side");
  facts.trainee = text(session, "participant");
  facts.blinded = !facts.trainee.empty();
  if (!facts.blinded) facts.trainee = text(session, "trainee");
  facts.created_utc = text(session, "created_utc");
  if (facts.created_utc.empty() && !recording.segments().empty())
    facts.created_utc = recording.segments()[0].utc;
  facts.attempt = session.value("attempt", 1);
  facts.theatre = session.value("theatre", false);
  facts.state = recording.end() ? recording.end()->state : "not closed in order";
  facts.fault = text(session, "fault");
  facts.reamer = text(session, "tool");
  facts.device = device_in_words(text(session, "device"));
  facts.device_profile = text(session, "device_profile");
  facts.feed_model = text(session, "model");
  facts.guide = guide_in_words(session);
  facts.force_scale = header.force_scale;
  facts.build = header.build;
  facts.scored_by = version_text();
  facts.case_hash = to_hex(header.case_hash);
  facts.start_grid_hash = to_hex(header.start_grid_hash);
  facts.grid_hash = text(metrics, "grid_hash");
  facts.session_hash = text(metrics, "session_hash");
  return facts;
}

std::string plan_in_words(const case_::Plan& plan) {
  std::string words = report::with_unit(plan.depth_mm, "mm") + " deep with " + plan.reamer;
  if (plan.pilot_hole)
    words += "; pilot hole " + report::shortest(plan.pilot_hole->diameter_mm) + " mm wide, " +
             report::shortest(plan.pilot_hole->depth_mm) + " mm deep";
  if (plan.implant_radius_mm)
    words += "; implant " + (plan.implant_size.empty() ? "" : plan.implant_size + ", ") + "back radius " +
             report::shortest(*plan.implant_radius_mm) + " mm";
  return words;
}

std::vector<report::Remark> remarks_of(const record::Recording& recording) {
  std::vector<report::Remark> remarks;
  for (const record::ops::Annotation& op : recording.annotations())
    remarks.push_back({op.tick * tick_s, op.words, op.author});
  std::stable_sort(remarks.begin(), remarks.end(),
                   [](const report::Remark& a, const report::Remark& b) { return a.at_s < b.at_s; });
  return remarks;
}

}  // namespace ream::session
