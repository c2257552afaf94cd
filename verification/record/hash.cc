#include <cases/error.h>
#include <verification/record/hash.h>

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <iterator>

namespace meltfront::verification
{
  std::string sha256(std::string_view text)
  {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
    unsigned int size = 0;
    if(EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_sha256(), nullptr)
       != 1)
      throw cases::OutputError("the SHA-256 of a text cannot be computed");
    std::string result;
    for(unsigned int i = 0; i < size; ++i)
      result += fmt::format("{:02x}", digest[i]);
    return result;
  }

  std::string sha256_of_file(const std::string &path)
  {
    std::ifstream in(path, std::ios::binary);
    if(!in)
      throw cases::OutputError(fmt::format("cannot read {}", path));
    return sha256(std::string(std::istreambuf_iterator<char>(in), {}));
  }
} // namespace meltfront::verification
