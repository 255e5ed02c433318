#include "peer/block.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace contct::app::peer {
namespace {

constexpr double youngs = 1e4;
constexpr double unit_of_force = block_force_scale / block_scale;

std::string mesh_of(const block& b, double modulus) {
  std::string text = "*NODE,NSET=ALL\n";
  for (int i = 0; i <= b.nx; ++i) {
    for (int j = 0; j <= b.ny; ++j) {
      for (int k = 0; k <= b.nz; ++k) {
        text += fmt::format("{},{:.12e},{:.12e},{:.12e}\n", b.at(i, j, k), b.length * i / b.nx,
                            b.width * j / b.ny, b.height * k / b.nz);
      }
    }
  }
  text += "*ELEMENT,TYPE=C3D8I,ELSET=BLOCK\n";
  int element = 0;
  for (int i = 0; i < b.nx; ++i) {
    for (int j = 0; j < b.ny; ++j) {
      for (int k = 0; k < b.nz; ++k) {
        text += fmt::format("{}", ++element);
        for (const int up : {0, 1}) {
          for (const auto& [di, dj] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
            text += fmt::format(",{}", b.at(i + di, j + dj, k + up));
        }
        text += '\n';
      }
    }
  }
  text += fmt::format(
      "*MATERIAL,NAME=M\n*ELASTIC\n{:.12e},0.3\n*DENSITY\n1.\n*SOLID SECTION,ELSET=BLOCK,MATERIAL=M\n",
      modulus);
  text += "*BOUNDARY\n";
  for (int j = 0; j <= b.ny; ++j) {
    for (int k = 0; k <= b.nz; ++k) text += fmt::format("{},1,3\n", b.at(0, j, k));
  }
  return text;
}

}  // namespace

std::string matrix_deck_of(const block& b) {
  return mesh_of(b, youngs) + "*STEP\n*FREQUENCY,SOLVER=MATRIXSTORAGE\n1\n*END STEP\n";
}

std::string peer_deck_of(const block& b, double load) {
  const auto where = [&](int node) {
    const int column = (node - 1) / (b.nz + 1);
    const int along = column / (b.ny + 1);
    return std::array{b.length * along / b.nx, b.width * (column % (b.ny + 1)) / b.ny,
                      b.height * ((node - 1) % (b.nz + 1)) / b.nz};
  };
  std::string text = mesh_of(b, youngs * unit_of_force);
  int ground = b.nodes();
  int element = b.nx * b.ny * b.nz;
  for (const gap_support& s : b.supports) {
    const auto [x, y, z] = where(s.node);
    ++ground;
    text += fmt::format("*NODE,NSET=GROUND\n{},{:.12e},{:.12e},{:.12e}\n", ground, x, y, z - b.height / 10);
    text += fmt::format("*ELEMENT,TYPE=SPRINGA,ELSET=S{}\n{},{},{}\n*SPRING,ELSET=S{},NONLINEAR\n", ground,
                        ++element, s.node, ground, ground);
    for (const double end : {-1e6, -4.0})
      text += fmt::format("{:.12e},{:.12e}\n", s.stiffness * end * block_force_scale,
                          (s.face + end) * block_scale);
    text += fmt::format("0.,{:.12e}\n0.,{:.12e}\n", s.face * block_scale, (s.face + 1e6) * block_scale);
  }
  text += "*BOUNDARY\nGROUND,1,3\n*STEP,NLGEOM\n*STATIC\n1.,1.\n";
  text += fmt::format("*CLOAD\n{},3,{:.12e}\n", b.loaded, load * block_force_scale);
  return text + "*NODE PRINT,NSET=ALL\nU\n*NODE PRINT,NSET=GROUND\nRF\n*END STEP\n";
}

std::string problem_of(const block& b) {
  std::string text = fmt::format("title = \"{}\"\n\n[calculix]\njob = \"{}\"\n", b.name, b.name);
  for (const gap_support& s : b.supports) {
    text += fmt::format("\n[[contact]]\ndof = \"{}.3\"\nsurface = \"below\"\nface = {}\nstiffness = {}\n",
                        s.node, s.face, s.stiffness);
  }
  for (const double load : b.loads)
    text += fmt::format("\n[[step]]\npoint = [ {{ dof = \"{}.3\", value = {} }} ]\n", b.loaded, load);
  return text;
}

}  // namespace contct::app::peer
