#include "contct/read/contact_face.hpp"

#include <fmt/format.h>

#include "contct/kernel/call.hpp"

namespace contct::read {

contact_pair read_face(const table_reader& t, int default_surface) {
  contact_pair p{};
  p.surface = default_surface;
  if (default_surface == 0 || t.has("surface"))
    p.surface = t.choice("surface", {"below", "above"}) == 0 ? face_below : face_above;
  p.face = t.real("face", any_real);
  if (p.surface * p.face < 0)
    t.refuse_key("face", fmt::format("{:g}: the face stands inside the undeformed structure", p.face),
                 p.surface < 0 ? "at most 0 for a face below" : "at least 0 for a face above");
  p.closed = p.face == 0;
  if (t.has("state")) p.closed = t.choice("state", {"separated", "contact"}) == 1;
  if (p.closed && p.face != 0)
    t.refuse_key("state", fmt::format("\"contact\" at face {:g}", p.face),
                 "\"contact\" only where face = 0: nothing touches a face elsewhere before the structure "
                 "deflects");
  return p;
}

void read_pair(const table_reader& t, int node, std::string_view fixed_dof, problem& p) {
  contact_pair pair = read_face(t, 0);
  pair.node = node;
  pair.stiffness = t.real("stiffness", positive_real);
  p.pairs.push_back(pair);
  if (!fixed_dof.empty())
    p.warnings.push_back(fmt::format(
        "{}: {}; the pair cannot change the answer, but the listing may toggle it", t.place(), fixed_dof));
}

}  // namespace contct::read
