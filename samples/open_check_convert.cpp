// The ten lines of the README: open, check, convert, mesh.  open_check_convert IN.igs OUT.glb
#include <trimloop/trimloop.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  trimloop::io::ReadResult in = trimloop::io::read(argv[1]);
  for (const trimloop::Diagnostic& finding : in.report.items()) std::puts(finding.text.c_str());
  if (!in.usable) return 1;
  trimloop::io::WriteOptions how;
  how.format = trimloop::io::Format::Glb;
  how.deflection = "0.05mm";
  const auto out = trimloop::io::encode(in.model, in.source, how);
  if (!out || !trimloop::io::save(argv[2], out->bytes, true)) return 1;
  std::printf("%zu triangles, off by at most %g mm\n", out->triangles, out->max_bound_mm);
}
