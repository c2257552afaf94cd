#ifndef meltfront_cases_case_file_output_reader_h
#define meltfront_cases_case_file_output_reader_h

#include <cases/case.h>
#include <cases/case_file/prm_file.h>
#include <cases/output_request.h>

namespace meltfront::cases
{
  /** Keys of the subsection `Output`. */
  void declare_output(PrmFile &prm);

  /** What a run writes beside its fields.
   * @throws InputError for places outside of the domain and times outside of the run */
  OutputRequest read_output(const PrmFile &prm, const Scene &scene);

  /** The same of a case that was read. */
  OutputRequest output_of(const Case &c);
} // namespace meltfront::cases

#endif
