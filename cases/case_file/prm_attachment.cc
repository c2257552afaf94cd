#include <cases/case_file/prm_attachment.h>
#include <cases/case_file/prm_include.h>
#include <cases/case_file/prm_scan.h>
#include <cases/case_file/prm_statement.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace meltfront::cases
{
  namespace
  {
    constexpr std::uintmax_t largest_attachment = 64 << 20;

    const std::string head = "#@ file ", margin = "#|";

    template <typename Visit>
    void visit_lines(const std::string &text, const Visit &visit)
    {
      for(std::size_t begin = 0; begin < text.size();)
      {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string_view line(text.data() + begin, end - begin);
        if(line.ends_with('\r'))
          line.remove_suffix(1);
        visit(line);
        begin = end + 1;
      }
    }
  } // namespace

  std::string attachment(const std::string &name, const std::string &text)
  {
    std::string result = "\n" + head + name + "\n";
    visit_lines(text, [&result](std::string_view line)
                { result.append(margin).append(line).append("\n"); });
    return result;
  }

  std::optional<std::string> attachment_in(const std::string &text,
                                           const std::string &name)
  {
    std::optional<std::string> result;
    bool within = false;
    visit_lines(text,
                [&](std::string_view line)
                {
                  if(line == head + name)
                  {
                    result.emplace();
                    within = true;
                  }
                  else if(!line.starts_with(margin))
                    within = false;
                  else if(within)
                    result->append(line.substr(margin.size())).append("\n");
                });
    return result;
  }

  std::string without_attachments(const std::string &text)
  {
    std::string result;
    visit_lines(text,
                [&result](std::string_view line)
                {
                  if(!line.starts_with(margin))
                    result.append(line).append("\n");
                });
    return result;
  }

  std::string read_attachment(const std::string &path)
  {
    std::string text = read_text_file(path, largest_attachment, "mesh file");
    static_cast<void>(prm_statements(text, quotable(path))); // its bytes are looked at
    return text;
  }
} // namespace meltfront::cases
