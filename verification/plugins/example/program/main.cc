// A program that links meltfront: it reads a case, runs the plugin's method and one of ours, and prints their
// errors.
#include <cases/case_file/case_file.h>
#include <cases/plugin.h>
#include <particles/sph/sph.h>
#include <verification/run/run_one.h>

#include <cstdio>

extern "C" const meltfront::cases::Plugin meltfront_plugin; // of slab_volumes.cc

int main() {
  const auto plane_freezing = meltfront::cases::load_case("plane-freezing");
  auto methods = meltfront_plugin.methods();
  methods.push_back(meltfront::particles::make_sph());
  bool finished = true;
  for (const auto &method : methods) {
    const meltfront::cases::Resolution resolution{
        80, meltfront::cases::Options(method->option_declarations())};
    const auto record =
        meltfront::verification::run_one(plane_freezing, *method, resolution, method->name(), {});
    finished = finished && record.status == meltfront::verification::RunStatus::finished;
    std::printf("%s: front_rms %.3e %s\n", method->name().c_str(), record.quantity("front_rms"),
        record.message.c_str());
  }
  return finished ? 0 : 1;
}
