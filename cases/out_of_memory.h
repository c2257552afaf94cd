#ifndef meltfront_cases_out_of_memory_h
#define meltfront_cases_out_of_memory_h

#include <memory>
#include <new>
#include <string>

namespace meltfront::cases
{
  /** Memory ran out, and what for is known. */
  class OutOfMemory : public std::bad_alloc
  {
  public:
    /** @param what one clause: `UMFPACK found none for the factors of 1000 unknowns` */
    explicit OutOfMemory(const std::string &what)
      : words(std::make_shared<const std::string>(what))
    {
    }

    const char *what() const noexcept override
    {
      return words->c_str();
    }

  private:
    std::shared_ptr<const std::string> words; ///< copied without allocating
  };
} // namespace meltfront::cases

#endif
