#include "listing/battery.hpp"

#include <cmath>

namespace contct_test {
namespace {

using calls = std::vector<battery_call>;

const int apart = 1;
const int touching = -1;
const int above = 1;
const int below = -1;

// EPSMUL. Multiples of it are exact, so a tie can be placed on its edge and one bit beside it.
const double edge = 0.00390625;

/// A separated pair over a face below, `s` of whose test response of -1 is free.
battery_pair makes_at(int node, double s) {
  return {node, 0.0, -1.0, -s, apart, below};
}

/// A closed pair on a face below, pressed by 1, that the test response lifts off at `s`.
battery_pair breaks_at(int node, double s) {
  return {node, -1.0, 1.0 / s, 0.0, touching, below};
}

/// A pair that stands at its face, at 0.
battery_pair at_face(int node, double d_star, int isep, int isurf) {
  return {node, 0.0, d_star, 0.0, isep, isurf};
}

calls single_pairs() {
  return {{"one pair at node 1 makes", {makes_at(1, 0.5)}},
          {"one pair at node 1, out of reach", {makes_at(1, 2.0)}},
          {"no pairs", {}},
          {"one pair beyond node 1 makes", {makes_at(7, 0.25)}},
          {"one pair breaks", {breaks_at(2, 0.5)}},
          {"a pressed pair stays pressed", {{2, -1.0, -3.0, 0.0, touching, below}}},
          {"a pair moves away from its face", {{2, 0.0, 1.0, -0.5, apart, below}}},
          {"a face above makes", {{3, 0.125, 4.0, 1.0, apart, above}}},
          {"a face above breaks", {{3, 1.5, -4.0, 1.0, touching, above}}},
          {"a face exactly at full load", {makes_at(2, 1.0)}},
          {"a face one bit before full load", {makes_at(2, std::nextafter(1.0, 0.0))}},
          {"a separated pair starts beyond its face", {{2, -1.0, 4.0, 0.0, apart, below}}}};
}

calls several_pairs() {
  return {{"two pairs, the second makes", {makes_at(2, 0.75), makes_at(3, 0.25)}},
          {"two pairs, the first makes", {makes_at(2, 0.25), makes_at(3, 0.75)}},
          {"three pairs, none in reach", {makes_at(2, 1.5), makes_at(3, 2.5), makes_at(4, 3.5)}},
          {"three pairs, the last makes", {makes_at(2, 0.9), makes_at(3, 0.8), makes_at(4, 0.3)}},
          {"a break before a make", {makes_at(2, 0.75), breaks_at(3, 0.5)}},
          {"a make before a break", {makes_at(2, 0.25), breaks_at(3, 0.5)}},
          {"a break between two makes", {makes_at(5, 0.6), breaks_at(4, 0.3), makes_at(3, 0.4)}},
          {"faces above and below one node",
           {{4, 0.0, -2.0, 1.0, apart, above}, {4, 0.0, -2.0, -1.0, apart, below}}},
          {"only the middle of three responds",
           {{2, 0.0, 0.0, -0.5, apart, below}, makes_at(3, 0.5), {4, 0.0, 0.0, -0.25, apart, below}}},
          {"no pair responds", {{2, 0.0, 0.0, -0.5, apart, below}, {3, 0.0, 0.0, 0.0, touching, below}}},
          {"a response of minus zero", {{2, 0.0, -0.0, -0.5, apart, below}, makes_at(3, 0.5)}},
          {"an awkward quotient", {{2, 0.1, -0.7, -0.2, apart, below}, {3, 0.3, 1.1, 0.7, apart, above}}},
          {"twelve pairs",
           {makes_at(2, 0.9), breaks_at(3, 0.8), makes_at(4, 2.0), at_face(5, -0.5, touching, below),
            makes_at(6, 0.31), breaks_at(7, 0.7), makes_at(8, 0.5), at_face(9, 0.5, apart, below),
            makes_at(10, 0.3), breaks_at(11, 0.3), makes_at(12, 0.4), breaks_at(13, 0.301)}}};
}

calls ties() {
  const double tie = 0.5 * (1.0 + edge);
  return {{"an exact tie of two makes", {makes_at(2, 0.5), makes_at(3, 0.5)}},
          {"an exact tie of two breaks", {breaks_at(2, 0.5), breaks_at(3, 0.5)}},
          {"an exact tie of a make and a break", {makes_at(2, 0.5), breaks_at(3, 0.5)}},
          {"a near tie one bit inside 2^-8", {makes_at(2, 0.5), makes_at(3, std::nextafter(tie, 0.0))}},
          {"a near tie exactly at 2^-8", {makes_at(2, 0.5), makes_at(3, tie)}},
          {"a near tie one bit outside 2^-8", {makes_at(2, 0.5), makes_at(3, std::nextafter(tie, 1.0))}},
          {"the later of a near tie comes first", {makes_at(2, 0.501), makes_at(3, 0.5)}},
          {"of three, two tie", {makes_at(2, 0.9), makes_at(3, 0.501), breaks_at(4, 0.5)}},
          {"a chain of near ties", {makes_at(2, 0.5), makes_at(3, 0.5015), makes_at(4, 0.503)}},
          {"a make near full load takes a pair that does not respond along",
           {{2, 0.0, 0.0, -0.5, apart, below}, makes_at(3, 0.9985)}},
          {"a make near full load takes a quiet stationary pair along",
           {at_face(2, -0.5, touching, below), makes_at(3, 0.9985)}}};
}

calls stationary_pairs() {
  return {
      {"stationary and separated, toward the face", {at_face(2, -0.01, apart, below)}},
      {"stationary and separated, away from the face", {at_face(2, 0.01, apart, below)}},
      {"stationary and closed, lifted", {at_face(2, 0.01, touching, below)}},
      {"stationary and closed, pressed", {at_face(2, -0.01, touching, below)}},
      {"stationary and closed under a face above, opens", {at_face(2, -0.01, touching, above)}},
      {"of two stationary, the second responds more",
       {at_face(2, -0.01, apart, below), at_face(3, -0.04, apart, below)}},
      {"of two stationary, the first responds more",
       {at_face(2, 0.04, touching, below), at_face(3, 0.01, touching, below)}},
      {"of two stationary, only the first is quiet",
       {at_face(2, -0.04, touching, below), at_face(3, 0.01, touching, below)}},
      {"two stationary within 2^-8", {at_face(2, 1.0, touching, below), at_face(3, 1.001, touching, below)}},
      {"stationary before a make", {makes_at(2, 0.01), at_face(3, 0.01, touching, below)}},
      {"a quiet stationary pair and a make", {makes_at(2, 0.5), at_face(3, -0.01, touching, below)}},
      {"three stationary, all quiet",
       {at_face(2, 0.3, apart, below), at_face(3, 0.2, apart, below), at_face(4, -0.1, touching, below)}},
      {"a gap just under EPSGAP", {{2, 0.0, -1.0, -0.999e-10, apart, below}}},
      {"a gap of EPSGAP", {{2, 0.0, -1.0, -1.0e-10, apart, below}}},
      {"overshot by less than EPSGAP", {{2, -0.999e-10, -1.0, 0.0, apart, below}}},
      {"a stationary factor with an exponent of three digits", {at_face(2, -1.0e100, apart, below)}}};
}

calls layouts() {
  return {{"two dofs a node, the second deflects", {makes_at(2, 0.5), breaks_at(5, 0.25)}, 2, 2},
          {"two dofs a node, the first deflects", {makes_at(2, 0.5), breaks_at(5, 0.25)}, 1, 2},
          {"three dofs a node, the third deflects", {makes_at(1, 0.5), makes_at(6, 0.75)}, 3, 3},
          {"three dofs a node, stationary", {at_face(6, -0.5, apart, below), makes_at(1, 0.5)}, 1, 3},
          {"nodes in falling order", {makes_at(9, 0.5), makes_at(8, 0.25), breaks_at(2, 0.75)}},
          {"node 999 makes", {makes_at(1, 0.75), makes_at(999, 0.5)}},
          {"node 1000 overflows its field", {makes_at(1, 0.75), makes_at(1000, 0.5)}},
          {"node 1000 of three dofs breaks", {breaks_at(1000, 0.5)}, 2, 3}};
}

}  // namespace

calls battery() {
  calls all;
  for (const calls& some : {single_pairs(), several_pairs(), ties(), stationary_pairs(), layouts()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace contct_test
