#include <unordered_map>

#include "kernel/heal/make_face.h"

namespace trimloop::heal {
namespace {

struct Uses {
  int count = 0;
  int sum = 0;  // +1 for a use along the edge, -1 against it
};

}  // namespace

void finish_shell(Body& body, ShellId id) {
  Shell& shell = body[id];
  std::unordered_map<EdgeId, Uses> uses;
  bool complete = !shell.faces.empty();
  for (const Shell::Use& use : shell.faces) {
    const Face& face = body[use.face];
    complete = complete && face.status != FaceStatus::Failed;
    for (const LoopId loop : face.loops)
      for (const Coedge& c : body[loop].coedges) {
        if (body[c.edge].is_pole) continue;
        Uses& u = uses[c.edge];
        ++u.count;
        u.sum += (c.reversed != face.reversed) != use.reversed ? -1 : 1;
      }
  }
  shell.closed = complete;
  // Two uses, or more where the solid touches itself along the edge: as many along it as against it bound a volume.
  for (const auto& [edge, u] : uses) shell.closed = shell.closed && u.sum == 0;
}

}  // namespace trimloop::heal
