#include "contct/read/contact_face.hpp"

#include <fmt/format.h>

#include "contct/kernel/call.hpp"

namespace contct {

contact_pair read_face(const table_reader& t, int default_surface) {
  contact_pair p{};
  p.surface = default_surface;
  if (default_surface == 0 || t.has("surface")) {
    p.surface = t.choice("surface", {"below", "above"}) == 0 ? face_below : face_above;
  }
  p.face = t.real("face", any_real);
  if (p.surface * p.face < 0) {
    t.refuse(t.required("face", ""), "face",
             fmt::format("{:g}: the face stands inside the undeformed structure", p.face),
             p.surface < 0 ? "at most 0 for a face below" : "at least 0 for a face above");
  }
  p.closed = p.face == 0;
  if (t.has("state")) {
    p.closed = t.choice("state", {"separated", "contact"}) == 1;
    if (p.closed && p.face != 0) {
      t.refuse(t.required("state", ""), "state", fmt::format("\"contact\" at face {:g}", p.face),
               "\"contact\" only where face = 0: nothing touches a face elsewhere before the structure "
               "deflects");
    }
  }
  return p;
}

}  // namespace contct
