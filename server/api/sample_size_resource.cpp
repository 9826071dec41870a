#include <nlohmann/json.hpp>
#include <string>

#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "net/problem.hpp"
#include "statistics/sample_size.hpp"

namespace ream::api {
namespace {

struct SampleSize {
  size_t needed = 0;
  bool per_group = false;
  const char* source = "";
};

/// RequestError 422 when the query lacks it.
double needed_number(const net::Request& request, const char* name) {
  if (query_text(request, name).empty())
    throw net::RequestError(422, "'" + std::string(name) + "' is missing; this question needs it",
                            {{"?" + std::string(name), "is missing"}});
  return query_number(request, name, 0.0);
}

SampleSize size_for(const net::Request& request) {
  const auto number = [&](const char* name) { return needed_number(request, name); };
  const statistics::TestAim aim{query_number(request, "significance", 0.05),
                                query_number(request, "power", 0.8)};
  const std::string question = query_text(request, "question");
  if (question == "means")
    return {statistics::size_for_two_means(number("effect"), aim), true,
            "Student's t test, non-central t (Cohen 1988, chapter 2)"};
  if (question == "shares")
    return {statistics::size_for_two_shares(number("first"), number("second"), aim), true,
            "Fleiss, Statistical Methods for Rates and Proportions, section 3.2"};
  const auto raters = static_cast<size_t>(number("raters"));
  if (question == "agreement")
    return {statistics::size_for_agreement_over(number("least"), number("expected"), raters, aim), false,
            "Walter, Eliasziw & Donner 1998, Stat Med 17"};
  return {statistics::size_for_agreement_width(number("expected"), number("width"), raters), false,
          "Bonett 2002, Stat Med 21"};
}

net::Response get_sample_size(const Services&, const net::Request& request) {
  const SampleSize size = size_for(request);
  return net::json_response(
      200, {{"needed", size.needed}, {"per_group", size.per_group}, {"source", size.source}});
}

}  // namespace

std::vector<Route> sample_size_routes() {
  return {{"GET", "/api/v1/sample-size", access::staff, not_audited, get_sample_size}};
}

}  // namespace ream::api
