#include <trimloop/trimloop.h>

#include <cstdio>

int main() {
  const trimloop::io::ReadResult in = trimloop::io::read_bytes("", "empty.igs");
  std::printf("%zu fatal findings in an empty file\n", in.report.count(trimloop::Severity::Fatal));
  return !in.usable && in.report.has_fatal() ? 0 : 1;
}
