#ifndef meltfront_cases_case_file_source_reader_h
#define meltfront_cases_case_file_source_reader_h

#include <cases/case_file/exact_reader.h>
#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

#include <string>
#include <vector>

namespace meltfront::cases
{
  /** The subsections of the file's sources, points and Gaussian spots. */
  std::vector<std::string> opened_sources(const PrmFile &prm);

  /** Read the sources: points into Scene::sources, Gaussian spots as heat that is
   * released throughout. @throws InputError */
  void read_sources(const PrmFile &prm, Scene &scene);

  /** Power and energy of the points, some of which are the exact solution's.
   * @throws InputError */
  void complete_sources(const PrmFile &prm, const KnownSolution &known, Scene &scene);
} // namespace meltfront::cases

#endif
