#ifndef meltfront_verification_record_hash_h
#define meltfront_verification_record_hash_h

#include <string>
#include <string_view>

namespace meltfront::verification
{
  /** SHA-256 of a text, 64 hexadecimal digits. */
  std::string sha256(std::string_view text);

  /** SHA-256 of a file's bytes. @throws cases::OutputError if it cannot be read. */
  std::string sha256_of_file(const std::string &path);
} // namespace meltfront::verification

#endif
