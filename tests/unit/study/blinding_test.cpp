#include "study/blinding.hpp"

#include <gtest/gtest.h>

namespace ream::study {
namespace {

session::SessionRequest session(const std::string& study) {
  session::SessionRequest made;
  made.id = "abc";
  made.trainee_id = "u-ada";
  made.trainee = "Ada Lovelace";
  made.study = study;
  made.participant = study.empty() ? "" : "K7-F3M";
  return made;
}

net::Caller caller(const std::string& role, const std::string& user_id = "u-other") {
  return {user_id, "Somebody", role, "", ""};
}

TEST(Blinding, HidesThePersonFromAllButOperatorsAndThemself) {
  for (const char* role : {"instructor", "trainee", "viewer", ""}) {
    const Blinding blinding(caller(role), {});
    EXPECT_TRUE(blinding.hides(session("s1"))) << role;
    const session::SessionRequest seen = blinding.seen(session("s1"));
    EXPECT_EQ(seen.trainee, "K7-F3M");
    EXPECT_EQ(seen.trainee_id, "");
    EXPECT_EQ(seen.study, "s1");
  }
  for (const net::Caller& who : {caller("operator"), caller("trainee", "u-ada"),
                                 caller("instructor", "u-ada"), caller("operator", "")})
    EXPECT_EQ(Blinding(who, {}).seen(session("s1")).trainee, "Ada Lovelace") << who.role;
}

TEST(Blinding, HidesNothingOutsideStudiesOrOnceUnblinded) {
  const Blinding blinding(caller("instructor"), {"s1"});
  EXPECT_EQ(blinding.seen(session("")).trainee, "Ada Lovelace");
  EXPECT_EQ(blinding.seen(session("s1")).trainee_id, "u-ada");
  EXPECT_TRUE(blinding.hides(session("s2")));
}

/// A session of somebody without an account is nobody's own: an empty id is no person.
TEST(Blinding, AnEmptyIdIsNobody) {
  session::SessionRequest guest = session("s1");
  guest.trainee_id.clear();
  EXPECT_TRUE(Blinding(caller("viewer", ""), {}).hides(guest));
}

}  // namespace
}  // namespace ream::study
