#include "force/feed_model.hpp"

#include "core/error.hpp"
#include "force/empirical_feed.hpp"
#include "force/oblique_feed.hpp"
#include "force/scraping.hpp"

namespace ream::force {

const char* to_text(FeedKind kind) {
  if (kind == FeedKind::oblique) return "oblique";
  if (kind == FeedKind::scraping) return "scraping";
  return "empirical";
}

FeedKind feed_kind_from_text(const std::string& text) {
  for (const FeedKind kind : {FeedKind::empirical, FeedKind::oblique, FeedKind::scraping})
    if (text == to_text(kind)) return kind;
  throw Error(ErrorKind::usage,
              "feed model \"" + text + "\" is not known; use empirical, oblique or scraping");
}

std::unique_ptr<FeedModel> make_feed_model(const FeedSettings& settings, const CuttingTool& tool) {
  if (settings.kind == FeedKind::oblique) return make_oblique_feed_model(settings, tool.lip);
  if (settings.kind == FeedKind::scraping) return make_scraping_feed_model(settings, tool.seated_area_mm2);
  return make_empirical_feed_model(settings, tool.lip);
}

}  // namespace ream::force
