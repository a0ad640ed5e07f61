//! Addresses of pages and folders in the web, as options take them.

/// Reads the address of a page.
///
/// # Errors
/// The rule, unless it begins with `https://` or `http://`, names a host and is free of spaces, control
/// characters, quotes and angle brackets.
pub fn page(text: &str) -> Result<String, String> {
    let rest = ["https://", "http://"].iter().find_map(|scheme| text.strip_prefix(scheme));
    let host = rest.and_then(|rest| rest.split(['/', '?', '#']).next());
    let is_other = |c: char| c.is_whitespace() || c.is_control() || ['"', '<', '>'].contains(&c);
    if host.is_some_and(|host| host.contains(char::is_alphanumeric)) && !text.contains(is_other) {
        return Ok(text.to_owned());
    }
    Err("must be an address such as https://example.org, without spaces, quotes and angle brackets".into())
}

/// Reads the address of a folder, to which names of files are added.
///
/// # Errors
/// As for [`page`], and if it has a query (`?`) or a fragment (`#`).
pub fn folder(text: &str) -> Result<String, String> {
    match page(text)? {
        address if address.contains(['?', '#']) => {
            Err("must be the address of a folder, without a query (?) and a fragment (#)".into())
        }
        address => Ok(address),
    }
}

/// Reads the name of a server, which a port may follow.
///
/// # Errors
/// The rule, unless it has letters, digits, `-`, `.` and, around and in an address, `[`, `]` and `:` alone.
pub fn host(text: &str) -> Result<String, String> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || "-.:[]".contains(c);
    if text.contains(|c: char| c.is_ascii_alphanumeric()) && text.chars().all(is_part) {
        return Ok(text.to_owned());
    }
    Err("must be the name of a server such as lab.example.org, without https:// and paths".into())
}

#[cfg(test)]
mod tests {
    use super::{folder, host, page};

    #[test]
    fn an_address_has_a_scheme_and_a_host() {
        for text in ["https://example.org", "http://[::1]:8017/videos/", "https://example.org/a?b=1#c"] {
            assert_eq!(page(text), Ok(text.to_owned()));
        }
        for text in ["", "s", "example.org", "ftp://example.org", "https://", "http:///a", "https://a b"] {
            assert!(page(text).is_err_and(|rule| rule.contains("https://")), "{text:?}");
        }
        assert_eq!(folder("https://example.org/a"), Ok("https://example.org/a".to_owned()));
        for text in ["https://example.org/a?b", "https://example.org/#c"] {
            assert!(folder(text).is_err_and(|rule| rule.contains("query")), "{text:?}");
        }
    }

    #[test]
    fn a_host_is_a_name() {
        for good in ["lab.example.org", "localhost", "127.0.0.1:8000", "[::1]"] {
            assert_eq!(host(good), Ok(good.to_owned()));
        }
        for bad in ["", "http://a/b", "a b", ".", "\u{1b}"] {
            assert!(host(bad).is_err(), "{bad:?}");
        }
    }
}
