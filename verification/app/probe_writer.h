#ifndef meltfront_verification_app_probe_writer_h
#define meltfront_verification_app_probe_writer_h

#include <cases/case.h>
#include <cases/method.h>
#include <cases/output_request.h>

#include <fstream>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /**
   * Writes what a case's subsection `Output` asks for to a directory: probes.csv (time,
   * then temperature and solid fraction of each probe) and line-1.csv, line-2.csv, ...
   * (time, the point, its distance from the line's start, temperature and solid
   * fraction). A row's time is that of the step that reaches the time asked for.
   *
   * Values at places are read_places() of the snapshots, the same for every method.
   */
  class ProbeWriter : public cases::Observer
  {
  public:
    /** Files of an earlier run in the directory are removed.
     * @throws cases::OutputError if a file cannot be written */
    ProbeWriter(const std::string &directory, const cases::Case &c);

    void begin(const cases::RunDescription &description) override;
    bool wants(long step, double time) override;
    void observe(const cases::Snapshot &snapshot) override;

  private:
    bool probes_due(double time) const;
    bool lines_due(double time) const;
    void write_probes(const cases::Snapshot &snapshot);
    void write_lines(const cases::Snapshot &snapshot);

    const cases::Scene &scene;
    cases::OutputRequest output;
    double spacing = 0;
    int next_sample = 0;
    std::size_t next_line_time = 0;
    std::ofstream probes;
    std::vector<std::ofstream> lines;
  };
} // namespace meltfront::verification

#endif
