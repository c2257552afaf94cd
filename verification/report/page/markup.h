#ifndef meltfront_verification_report_page_markup_h
#define meltfront_verification_report_page_markup_h

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meltfront::verification
{
  /**
   * HTML that is ready to stand in a page. Text from outside becomes markup only through
   * text(), which escapes it; so a name with `<` or `&` can never break a page.
   */
  class Markup
  {
  public:
    Markup() = default;

    /** Take over HTML that the report itself has written. */
    explicit Markup(std::string html);

    Markup &operator+=(const Markup &other);

    const std::string &html() const;

    bool empty() const;

  private:
    std::string source;
  };

  Markup operator+(Markup left, const Markup &right);

  using Attributes = std::vector<std::pair<std::string, std::string>>;

  /** `&`, `<`, `>` and both quotes as character references; control characters that no
   * page may hold are dropped. */
  std::string escape(std::string_view plain);

  /** Plain text as markup. */
  Markup text(std::string_view plain);

  /** `<name attributes>content</name>`; attribute values are escaped here. */
  Markup element(const std::string &name, const Attributes &attributes,
                 const Markup &content);

  Markup element(const std::string &name, const Markup &content);

  /** An element whose content is plain text. */
  Markup element(const std::string &name, const std::string &plain);

  /** An element without content, closed as XML wants it: `<br/>`. */
  Markup void_element(const std::string &name, const Attributes &attributes = {});

  /** A list of the items, `ul` or `ol`; nothing for no items. */
  Markup list(const std::string &name, const std::vector<Markup> &items);

  /** A `data:` address that holds the content itself, percent-encoded. */
  std::string data_address(const std::string &media_type, std::string_view content);

  /** Letters, digits, `.`, `_`, `-` of a name, anything else as `_`: for files and
   * anchors. */
  std::string plain_name(std::string_view name);
} // namespace meltfront::verification

#endif
