#include "golden/cases.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>

namespace golden {
namespace {

using contct::call_inputs;
using contct::face_above;
using contct::face_below;
using contct::in_contact;
using contct::separated;

/// The state of one pair: D, d*, c, ISEP and ISURF.
template <class Real>
struct pair_at {
  Real dd, dtest, cc;
  int isep = separated;
  int isurf = face_above;
};

/// Returns a call with pair i at node i + 1 and one dof a node.
template <class Real>
call_inputs<double> at_own_nodes(const std::vector<pair_at<Real>>& pairs) {
  call_inputs<double> in;
  for (const auto& p : pairs) {
    in.dd.push_back(p.dd);
    in.dtest.push_back(p.dtest);
    in.cc.push_back(p.cc);
    in.id.push_back(static_cast<int>(in.id.size()) + 1);
    in.isep.push_back(p.isep);
    in.isurf.push_back(p.isurf);
  }
  return in;
}

template <class Real>
class cases {
  using limits = std::numeric_limits<Real>;
  using pairs = std::vector<pair_at<Real>>;

 public:
  std::vector<golden_trace> all() const {
    return {quiet(),   stationary(), open_gap(), ties(),     full_load(),
            layouts(), numbers(),    text(),     statuses(), inconsistent()};
  }

 private:
  static constexpr int bytes = sizeof(Real);
  static std::string named(const std::string& name) { return name + (bytes == 4 ? "-r4" : ""); }
  /// Returns the number with this decimal text. A power function would round differently on other machines.
  static Real decimal(const std::string& text) {
    return static_cast<Real>(std::strtod(text.c_str(), nullptr));
  }
  static Real up(Real x) { return std::nextafter(x, limits::infinity()); }
  static Real down(Real x) { return std::nextafter(x, -limits::infinity()); }
  static golden_call one(std::string note, const pairs& p) {
    return {std::move(note), at_own_nodes<Real>(p)};
  }

  static inline const Real epsgap = bytes == 4 ? static_cast<Real>(1.E-10F) : static_cast<Real>(1.E-10);
  static inline const Real inf = limits::infinity();
  static inline const Real nan = limits::quiet_NaN();
  static inline const Real tiny = limits::denorm_min();
  static inline const Real half = Real(0.5);
  static constexpr Real subnormal_gap =
      bytes == 4 ? Real(1e-6) : Real(1e-9);  // subnormal after division by the largest number
  static constexpr Real gap_of_tiny =
      bytes == 4 ? Real(0x1p-21) : Real(0x1p-50);  // the smallest number after division by the largest number

  golden_trace quiet() const {
    return {named("quiet"),
            bytes,
            {"IF (DTEST(NDOF).EQ.0.): a pair that the load does not move has SS = 1 and no event;",
             "both zeros are zero, the smallest number is not"},
            {one("no pairs at all: DO 10 runs no time", {}), one("d* = +0, open", {{0, 0, half}}),
             one("d* = -0, open", {{0, -Real(0), half}}),
             one("d* = +0, at its face", {{half, 0, half, in_contact}}),
             one("d* = -0, at its face", {{half, -Real(0), half, in_contact}}),
             one("d* the smallest number: it responds, and SS overflows", {{0, tiny, half}}),
             one("d* the smallest negative number", {{0, -tiny, half}}),
             one("a quiet pair beside one with an event", {{0, 0, half}, {0, 1, half}}),
             one("a quiet pair behind one with an event", {{0, 1, half}, {0, -Real(0), half}})}};
  }

  golden_trace stationary() const {
    golden_trace t{named("stationary"),
                   bytes,
                   {"ELSE IF (ABS(GAP).LT.EPSGAP): a pair at its face; EPSGAP to the ULP on both sides and",
                    "exactly; then IF (SSCHK.GT.0.): the sign of ISEP * ISURF / d* decides, DELTA scales"},
                   {}};
    for (const int isep : {separated, in_contact}) {
      for (const int isurf : {face_above, face_below}) {
        for (const Real d_star : {Real(2), Real(-2)}) {
          t.calls.push_back(
              one("at the face: ISEP * ISURF / d* " +
                      std::string((isep * isurf > 0) == (d_star > 0) ? "> 0: an event" : "< 0: none"),
                  {{half, d_star, half, isep, isurf}}));
        }
      }
    }
    for (const auto& [gap, words] : {std::pair(down(epsgap), "one ULP below EPSGAP"),
                                     {epsgap, "exactly EPSGAP"},
                                     {up(epsgap), "one ULP above EPSGAP"}}) {
      t.calls.push_back(one(std::string("gap ") + words, {{0, 3, gap}}));
      t.calls.push_back(one(std::string("gap negative, ") + words, {{0, 3, -gap, in_contact}}));
      t.calls.push_back(one(std::string("gap from D, ") + words, {{gap, -3, 0, separated, face_below}}));
    }
    t.calls.push_back(one("SSCHK = +0: d* is infinite", {{0, inf, 0}}));
    t.calls.push_back(one("SSCHK = -0: d* is infinite", {{0, -inf, 0}}));
    t.calls.push_back(one("SSCHK overflows: d* is subnormal", {{0, tiny, 0}}));
    t.calls.push_back(one("SSCHK is NaN, and NaN is not > 0", {{0, nan, 0}}));
    t.calls.push_back(one("SSCHK * DELTA underflows to zero: no event after all", {{0, limits::max(), 0}}));
    t.calls.push_back(
        one("of two pairs at their faces the one with the larger d* wins", {{0, 1, 0}, {0, 4, 0}}));
    t.calls.push_back(one("the same, the other way round", {{0, 4, 0}, {0, 1, 0}}));
    t.calls.push_back(one("a pair at its face wins over an open one", {{0, 4, half}, {0, 1, 0}}));
    t.calls.push_back(one("a gap of -0: c = -0, D = +0", {{0, 5, -Real(0)}}));
    t.calls.push_back(one("two pairs at their faces, in contact, pulled off at equal d*",
                          {{half, 1, half, in_contact, face_below}, {1, 1, 1, in_contact, face_below}}));
    return t;
  }

  golden_trace open_gap() const {
    return {
        named("open"),
        bytes,
        {"SS(I) = GAP / DTEST(NDOF), and IF (SS(I).GT.0. .AND. SS(I).LT.SMIN): who moves away has SS < 0,",
         "who comes too late has SS >= 1, and the first of the least wins"},
        {one("towards a face above: an event half way", {{0, 1, half}}),
         one("towards a face below: an event half way", {{0, -1, -half, separated, face_below}}),
         one("away from a face above", {{0, -1, half}}),
         one("away from a face below", {{0, 1, -half, separated, face_below}}),
         one("too late: the gap is longer than the way", {{0, 1, Real(1.5)}}),
         one("in contact beyond its face: an event", {{1, -1, half, in_contact}}),
         one("an open pair that stands beyond its face and comes back makes contact", {{1, -1, half}}),
         one("three pairs, the middle one first", {{0, 1, Real(0.75)}, {0, 1, Real(0.25)}, {0, 1, half}}),
         one("three pairs, the last one first", {{0, 1, Real(0.75)}, {0, 1, half}, {0, 1, Real(0.25)}}),
         one("one that moves away before one with an event", {{0, -1, half}, {0, 1, half}}),
         one("SS is subnormal, and greater than zero", {{0, limits::max(), subnormal_gap}}),
         one("SS is the least that an open gap can have; in 4 bytes it underflows to zero",
             {{0, limits::max(), up(epsgap)}}),
         one("the same, negative", {{0, -limits::max(), up(epsgap)}})}};
  }

  golden_trace ties() const {
    const Real edge = half + half / Real(256);
    return {
        named("ties"),
        bytes,
        {"IF (DIFF.LT.EPSMUL): the winner is toggled, and with it whatever comes within 2^-8 of it;",
         "exact ties, near ties at the edge and one ULP on either side, from above and from below"},
        {one("an exact tie: both", {{0, 1, half}, {0, 1, half}}),
         one("an exact tie of a make and a break", {{0, 1, half}, {0, 1, half, in_contact, face_below}}),
         one("DIFF one ULP below EPSMUL: both", {{0, 1, half}, {0, 1, down(edge)}}),
         one("DIFF exactly EPSMUL: only the first", {{0, 1, half}, {0, 1, edge}}),
         one("DIFF one ULP above EPSMUL: only the first", {{0, 1, half}, {0, 1, up(edge)}}),
         one("the winner last: DIFF one ULP below EPSMUL", {{0, 1, down(edge)}, {0, 1, half}}),
         one("the winner last: DIFF exactly EPSMUL", {{0, 1, edge}, {0, 1, half}}),
         one("the winner last: DIFF one ULP above EPSMUL", {{0, 1, up(edge)}, {0, 1, half}}),
         one("a difference of one ULP", {{0, 1, half}, {0, 1, up(half)}}),
         one("a difference of one ULP, the winner last", {{0, 1, half}, {0, 1, down(half)}}),
         one("near ties are measured from the winner, not in a chain",
             {{0, 1, half}, {0, 1, Real(0.5015)}, {0, 1, Real(0.503)}}),
         one("two pairs at their faces within EPSMUL of each other", {{0, Real(1), 0}, {0, Real(1.002), 0}}),
         one("SMIN a third: DIFF is a quotient", {{0, 3, 1}, {0, Real(2.99), 1}}),
         one("SMIN a third, SS just outside", {{0, 3, 1}, {0, Real(2.988), 1}}),
         one("a pair with SS infinite is not within EPSMUL", {{0, 1, half}, {0, tiny, half}}),
         one("a pair with SS negative is not within EPSMUL", {{0, 1, half}, {0, -1, half}}),
         one("a pair with SS NaN is not within EPSMUL", {{0, 1, half}, {0, 1, nan}})}};
  }

  golden_trace full_load() const {
    const Real edge = Real(256) / Real(257);
    return {
        named("full-load"),
        bytes,
        {"IF (SMIN.EQ.1.): SS = 1 is the mark for \"no event\"; an event exactly at full load is none, one "
         "an",
         "ULP before it is one, and the mark itself is within EPSMUL of any SMIN above 256/257: there the",
         "listing toggles quiet pairs"},
        {one("an event exactly at full load: none", {{0, 1, 1}}),
         one("one ULP before full load", {{0, 1, down(Real(1))}}),
         one("one ULP behind full load", {{0, 1, up(Real(1))}}),
         one("SMIN below 256/257 beside a quiet pair: the quiet pair stays",
             {{0, 1, Real(0.99)}, {half, 0, half, in_contact}}),
         one("SMIN just above 256/257 beside a quiet pair: the quiet pair is toggled",
             {{0, 1, Real(0.997)}, {half, 0, half, in_contact}}),
         one("SMIN = 256/257 rounded", {{0, 1, edge}, {half, 0, half, in_contact}}),
         one("SMIN = 256/257 less an ULP", {{0, 1, down(edge)}, {half, 0, half, in_contact}}),
         one("SMIN = 256/257 and an ULP", {{0, 1, up(edge)}, {half, 0, half, in_contact}}),
         one("a pressed pair at its face has SS = 1 and is toggled too",
             {{0, 1, Real(0.999)}, {half, 1, half, in_contact, face_above}}),
         one("a pair that comes at SS = 1.003 is toggled with SMIN = 0.9999",
             {{0, 1, Real(0.9999)}, {0, 1, Real(1.003)}}),
         one("two events exactly at full load: none", {{0, 1, 1}, {0, 2, 2}})}};
  }

  /// Returns a call with two pairs, whose other dofs have decoy values, so that a wrong address changes the
  /// answer.
  static golden_call laid_out(int indof, int ndofpn, int first, int second) {
    call_inputs<double> in;
    in.dof = {indof, ndofpn};
    const int nodes = 5;
    for (int dof = 1; dof <= nodes * ndofpn + indof; ++dof) {
      in.dd.push_back(static_cast<Real>(dof) / Real(64));
      in.dtest.push_back(static_cast<Real>(100 - dof) / Real(8));
    }
    in.id = {first, second};
    in.cc = {in.dd[in.dof_of_pair(0)] + 2, in.dd[in.dof_of_pair(1)] + 3};
    in.isep = {separated, separated};
    in.isurf = {face_above, face_above};
    return {"INDOF = " + std::to_string(indof) + ", NDOFPN = " + std::to_string(ndofpn) + ", nodes " +
                std::to_string(first) + " and " + std::to_string(second),
            in};
  }

  golden_trace layouts() const {
    golden_trace t{
        named("layouts"),
        bytes,
        {"NDOF = (NODE-1) * NDOFPN + INDOF: every layout of dofs, pairs in and against the order of nodes,",
         "two pairs on one node, the first and the last dof"},
        {}};
    for (const int ndofpn : {1, 2, 3, 6})
      for (int indof = 1; indof <= ndofpn; ++indof) t.calls.push_back(laid_out(indof, ndofpn, 2, 4));
    t.calls.push_back(laid_out(3, 2, 1, 2));  // INDOF beyond NDOFPN still addresses the dof of the formula
    t.calls.push_back(laid_out(1, 2, 5, 1));
    t.calls.push_back(laid_out(2, 3, 3, 3));
    t.calls.push_back(laid_out(1, 1, 1, 5));
    golden_call quiet = laid_out(2, 2, 2, 1);
    quiet.in.dtest[1] = 0;
    quiet.note += ": the quiet pair's dof has the number of the other's node";
    t.calls.push_back(quiet);
    return t;
  }

  golden_trace numbers() const {
    const Real max = limits::max();
    return {
        named("numbers"),
        bytes,
        {"The edges of arithmetic: signed zeros, subnormals, the largest numbers, overflow to infinity, NaN.",
         "NaN compares false: a NaN gap is not stationary, a NaN SS is no event"},
        {one("D is NaN", {{nan, 1, half}}),
         one("d* is NaN", {{0, nan, half}}),
         one("c is NaN", {{0, 1, nan}}),
         one("a NaN pair before one with an event", {{0, nan, half}, {0, 1, half}}),
         one("a NaN pair behind one with an event", {{0, 1, half}, {0, nan, half}}),
         one("c - D overflows", {{-max, 1, max}}),
         one("c - D overflows to minus infinity", {{max, -1, -max}}),
         one("infinity less infinity", {{inf, 1, inf}}),
         one("infinite gap, infinite response", {{0, inf, inf}}),
         one("finite gap, infinite response: SS = 0", {{0, inf, half}}),
         one("finite gap, response minus infinity: SS = -0", {{0, -inf, half}}),
         one("SS overflows", {{0, limits::min() / 2, max}}),
         one("the largest gap, the largest response", {{0, max, max / 2}}),
         one("a subnormal response, an event beyond reach", {{0, limits::min() / 4, half}}),
         one("a subnormal gap counts as none", {{0, 1, limits::min() / 4}}),
         one("c and D differ in the last place", {{half, 1, up(half)}}),
         one("c and D large, their difference exact", {{Real(1e6), Real(1e6), Real(1e6) + 1}}),
         one("d* = 1/3: a quotient that is rounded", {{Real(0.1), Real(1) / Real(3), Real(0.3)}}),
         one("signed zeros everywhere", {{-Real(0), -Real(0), -Real(0)}, {0, -Real(0), 0}}),
         one("DIFF = (inf - s) / s beside a tie", {{0, 1, half}, {0, limits::min() / 2, max}, {0, 1, half}}),
         one("c - D is rounded, and the quotient of the rounded gap is not that of the gap",
             {{Real(-0.02), 3, Real(0.3)}}),
         one("DIFF below EPSMUL of subnormal SS, where EPSMUL * SMIN is rounded to their difference: both",
             {{0, max, gap_of_tiny * (bytes == 4 ? 320 : 112704)},
              {0, max, gap_of_tiny * (bytes == 4 ? 321 : 113144)}})}};
  }

  golden_trace text() const {
    golden_trace t{
        named("text"),
        bytes,
        {"Unit 26: FORMATs 20, 40, 50 and 60; I3 above 999 and below -99 is ***; E11.4 over the decades, its",
         "rounding, and the E that is dropped where the exponent has three digits"},
        {}};
    const int least = bytes == 4 ? -30 : -290;
    for (int decade = 0; decade >= least; decade -= decade > -12 ? 1 : 26) {
      const auto s = decimal("0.123456E" + std::to_string(decade));
      // A gap below EPSGAP would count as zero, with s = DELTA / d*, so a small s needs a large response.
      const Real response = decade > -9 ? Real(1) : Real(1e-3) / s;
      t.calls.push_back(one("a scale factor of about 1e" + std::to_string(decade),
                            {{0, response, decade > -9 ? s : Real(1e-3)}}));
    }
    t.calls.push_back(one("E11.4 rounds up into the next decade", {{0, 1, Real(0.0999999)}}));
    t.calls.push_back(
        one("E11.4 of a tie in decimal: 0.12345 exactly is not a number", {{0, 1, Real(0.12345)}}));
    t.calls.push_back(
        one("0.5 + 2^-5 has a short tail: 0.53125 is rounded to even", {{0, 1, Real(0.53125)}}));
    t.calls.push_back(one("0.59375", {{0, 1, Real(0.59375)}}));
    t.calls.push_back(one("a subnormal scale factor", {{0, limits::max(), subnormal_gap}}));
    golden_call far = one("nodes beyond 999 and sides that are none: ***", {{0, 1, half}});
    far.in.dd.assign(1200, 0.0);
    far.in.dtest.assign(1200, 1.0);
    far.in.id = {1000};
    t.calls.push_back(far);
    far.in.id = {999};
    far.in.isurf = {1000};
    far.note = "node 999 fits, side 1000 does not";
    t.calls.push_back(far);
    far.in.isurf = {-99};
    far.note = "side -99 fits";
    t.calls.push_back(far);
    far.in.isurf = {-100};
    far.note = "side -100 does not";
    t.calls.push_back(far);
    if (bytes == 8) {
      t.calls.push_back(thousand_pairs());
      for (const int decade : {-99, -100})
        t.calls.push_back(one("the E is dropped from -100 on: 1e" + std::to_string(decade),
                              {{0, Real(1e-3) / decimal("0.123456E" + std::to_string(decade)), Real(1e-3)}}));
    }
    return t;
  }

  /// Returns a call with pair numbers above 999, which overflow I3.
  static golden_call thousand_pairs() {
    golden_call c{"a thousand pairs on one node; the last is toggled, and its number is ***", {}};
    c.in.dd = {0.0, 0.0};
    c.in.dtest = {0.0, 1.0};
    c.in.id.assign(1000, 1);
    c.in.cc.assign(1000, 0.5);
    c.in.isep.assign(1000, separated);
    c.in.isurf.assign(1000, face_above);
    c.in.id.back() = 2;
    return c;
  }

  /// Returns calls with initial states that their faces contradict: way 5 of reference/DIVERGENCES.md.
  golden_trace inconsistent() const {
    const Real deep = decimal("0.1");
    return {
        named("inconsistent-start"),
        bytes,
        {"An initial state that its faces contradict: the listing does not notice, and toggles the wrong way",
         "round. Problem files refuse such states; DIVERGENCES, way 5"},
        {one("separated, the face below is inside the structure, and it is pressed deeper: no event",
             {{0, -1, deep, separated, face_below}}),
         one("separated, inside, and the structure leaves: it makes contact where it should let go",
             {{0, 1, deep, separated, face_below}}),
         one("in contact off its face, and the structure reaches it: it breaks",
             {{0, -1, -deep, in_contact, face_below}})}};
  }

  golden_trace statuses() const {
    golden_trace t{
        named("statuses"),
        bytes,
        {"IF (ISEP(I).EQ.1): +1 makes contact, anything else breaks it: the listing does not check. In DO 10",
         "a status that is none counts by its sign and size"},
        {}};
    for (const int isep : {separated, in_contact, 0, 2, -2, 7}) {
      t.calls.push_back(one("open, ISEP = " + std::to_string(isep), {{0, 1, half, isep, face_above}}));
      t.calls.push_back(
          one("at its face, ISEP = " + std::to_string(isep), {{half, 3, half, isep, face_above}}));
    }
    for (const int isurf : {0, 2, -3})
      t.calls.push_back(
          one("at its face, ISURF = " + std::to_string(isurf), {{half, -3, half, separated, isurf}}));
    t.calls.push_back(one("a make and a break in one call",
                          {{0, 1, half, separated, face_above}, {1, -1, half, in_contact, face_above}}));
    return t;
  }
};

}  // namespace

std::vector<golden_trace> all_traces() {
  std::vector<golden_trace> all = cases<double>().all();
  for (golden_trace& t : cases<float>().all()) all.push_back(std::move(t));
  return all;
}

}  // namespace golden
