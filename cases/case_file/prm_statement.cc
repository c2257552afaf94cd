#include <cases/case_file/prm_scan.h>
#include <cases/case_file/prm_statement.h>
#include <cases/error.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::cases
{
  namespace
  {
    bool is_text(const std::string &line)
    {
      for(std::size_t i = 0; i < line.size();)
      {
        const std::size_t size = character_size(line, i);
        const auto byte = static_cast<unsigned char>(line[i]);
        if(size == 0 || (byte < 0x20 && byte != '\t') || byte == 0x7f)
          return false;
        i += size;
      }
      return true;
    }
  } // namespace

  std::size_t character_size(const std::string &text, std::size_t at)
  {
    const auto byte = [&text](std::size_t i)
    { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const unsigned first = byte(at);
    std::size_t size = 0;
    if(first < 0x80)
      size = 1;
    else if(first >= 0xc2 && first < 0xe0)
      size = 2;
    else if(first >= 0xe0 && first < 0xf0)
      size = 3;
    else if(first >= 0xf0 && first < 0xf5)
      size = 4;
    for(std::size_t i = 1; i < size; ++i)
      if((byte(at + i) & 0xc0) != 0x80)
        return 0;
    const unsigned second = byte(at + 1);
    const bool overlong
        = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
    const bool surrogate = first == 0xed && second >= 0xa0;
    const bool beyond_unicode = first == 0xf4 && second >= 0x90;
    return overlong || surrogate || beyond_unicode ? 0 : size;
  }

  std::vector<PrmStatement> prm_statements(const std::string &text,
                                           const std::string &file)
  {
    std::vector<PrmStatement> result;
    int line_number = 0;
    bool continues = false;
    std::size_t begin = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
    while(begin < text.size())
    {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      std::string line = text.substr(begin, end - begin);
      begin = end + 1;
      ++line_number;
      if(!line.empty() && line.back() == '\r')
        line.pop_back();
      if(!is_text(line))
        throw InputError(fmt::format("{}:{}: the line is not UTF-8 text (it holds a "
                                     "control character or a broken one)",
                                     file, line_number));
      line = trimmed(line.substr(0, line.find('#')));
      const bool goes_on = !line.empty() && line.back() == '\\';
      if(goes_on)
        line = trimmed(line.substr(0, line.size() - 1));
      if(!continues)
        result.push_back({line, line_number, line_number});
      else
      {
        result.back().last_line = line_number;
        if(!line.empty())
          result.back().text += " " + line;
      }
      continues = goes_on;
    }
    return result;
  }

  std::optional<std::string> after_word(const std::string &statement,
                                        const std::string &word)
  {
    if(!statement.starts_with(word))
      return {};
    if(statement.size() == word.size())
      return "";
    if(statement[word.size()] != ' ' && statement[word.size()] != '\t')
      return {};
    return trimmed(statement.substr(word.size()));
  }
} // namespace meltfront::cases
