#include "study/blinding.hpp"

#include <gtest/gtest.h>

namespace ream::study {
namespace {

session::SessionRequest request(const std::string& study) {
  session::SessionRequest made;
  made.id = "abc";
  made.trainee_id = "u-ada";
  made.trainee = "Ada Lovelace";
  made.study = study;
  made.participant = study.empty() ? "" : "K7-F3M";
  return made;
}

session::SessionRecord session(const std::string& study) {
  session::SessionRecord made;
  made.request = request(study);
  made.request.phase = "post";
  made.request.title = "Ada's best";
  made.mark = session::SessionMark{};
  return made;
}

net::Caller caller(const std::string& role, const std::string& user_id = "u-other") {
  return {user_id, "Somebody", role, "", ""};
}

TEST(Blinding, HidesThePersonFromAllButOperatorsAndThemself) {
  for (const char* role : {"instructor", "trainee", "viewer", ""}) {
    const Blinding blinding(caller(role), {}, {});
    EXPECT_TRUE(blinding.hides(request("s1"))) << role;
    const session::SessionRequest seen = blinding.seen(session("s1")).request;
    EXPECT_EQ(seen.trainee, "K7-F3M");
    EXPECT_EQ(seen.trainee_id, "");
    EXPECT_EQ(seen.study, "s1");
  }
  for (const net::Caller& who : {caller("operator"), caller("trainee", "u-ada"),
                                 caller("instructor", "u-ada"), caller("operator", "")})
    EXPECT_EQ(Blinding(who, {}, {}).seen(session("s1")).request.trainee, "Ada Lovelace") << who.role;
}

TEST(Blinding, HidesNothingOutsideStudiesOrOnceUnblinded) {
  const Blinding blinding(caller("instructor"), {"s1"}, {});
  EXPECT_EQ(blinding.seen(session("")).request.trainee, "Ada Lovelace");
  EXPECT_EQ(blinding.seen(session("s1")).request.trainee_id, "u-ada");
  EXPECT_TRUE(blinding.hides(request("s2")));
}

/// A session of somebody without an account is nobody's own: an empty id is no person.
TEST(Blinding, AnEmptyIdIsNobody) {
  session::SessionRequest guest = request("s1");
  guest.trainee_id.clear();
  EXPECT_TRUE(Blinding(caller("viewer", ""), {}, {}).hides(guest));
}

TEST(Blinding, WhoRatesKnowsNeitherCodeNorScore) {
  const Blinding rater(caller("instructor"), {"s1"}, {"s1"});
  const session::SessionRecord seen = rater.seen(session("s1"));
  EXPECT_EQ(seen.request.participant, "");
  EXPECT_EQ(seen.request.trainee, "");
  EXPECT_EQ(seen.request.trainee_id, "");
  EXPECT_EQ(seen.request.phase, "");
  EXPECT_EQ(seen.request.title, "");
  EXPECT_FALSE(seen.mark);
  EXPECT_EQ(seen.request.study, "s1");
  EXPECT_TRUE(rater.seen(session("s2")).mark) << "rates another study";
  const Blinding trained_it(caller("instructor", "u-ada"), {}, {"s1"});
  EXPECT_EQ(trained_it.seen(session("s1")).request.trainee, "Ada Lovelace");
}

TEST(Blinding, WhatCannotBeLookedUpIsHidden) {
  const Blinding unsure = Blinding::of_nothing_known(caller("instructor"));
  EXPECT_EQ(unsure.seen(session("s1")).request.participant, "");
  EXPECT_FALSE(unsure.seen(session("s1")).mark);
  EXPECT_EQ(unsure.seen(session("")).request.trainee, "Ada Lovelace") << "outside studies";
  EXPECT_EQ(Blinding::of_nothing_known(caller("operator")).seen(session("s1")).request.trainee,
            "Ada Lovelace");
}

}  // namespace
}  // namespace ream::study
