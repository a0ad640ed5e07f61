//! Settings of a server.

use crate::headers::host;
use axum::http::HeaderMap;
use phase_game::GameSettings;
use std::{net::SocketAddr, path::PathBuf};

/// The settings of a server.
#[derive(Clone, Debug)]
pub struct ServerSettings {
    /// Address at which the server listens; with port 0 the system chooses one.
    pub listen: SocketAddr,
    /// Its name for others, where there is a proxy or a public address: a host, with the port if it is not
    /// the usual one. Requests by another name are refused.
    pub host: Option<String>,
    /// Whether nothing is served but rating studies and the admin page.
    pub only_studies: bool,
    /// Whether a proxy in front of it names the client (`X-Forwarded-For`).
    pub behind_proxy: bool,
    /// Folder for journals, recordings and answers.
    pub folder: PathBuf,
    /// Games at the same time, at most.
    pub rooms: usize,
    /// Of them games in which a mind plays, at most: minds need most of a processor's time, and a server that
    /// has too little is late with every step.
    pub mind_rooms: usize,
    /// Whether anybody may open a room, or only the holder of the admin token.
    pub open: bool,
    /// Rounds of a game after the practice.
    pub rounds: usize,
    /// Settings of games; who plays, and what is seen, can be chosen for each.
    pub game: GameSettings,
    /// Seed of the order of scenes and of the minds.
    pub seed: u64,
}

impl ServerSettings {
    /// Whether a request names this server by a name that it has.
    pub(crate) fn is_known_host(&self, headers: &HeaderMap) -> bool {
        let Some(named) = host(headers) else { return false };
        if let Some(own) = &self.host
            && own.eq_ignore_ascii_case(named.as_str())
        {
            return true;
        }
        let name = named.host().trim_matches(['[', ']']);
        let address: Option<std::net::IpAddr> = name.parse().ok();
        // An address cannot be pointed elsewhere; a name can, so it has to be given.
        name.eq_ignore_ascii_case("localhost") || address.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::http::{HeaderValue, header};

    #[test]
    fn only_own_names_and_addresses_are_known() {
        let settings = |host: Option<&str>| ServerSettings {
            listen: ([127, 0, 0, 1], 8017).into(),
            host: host.map(Into::into),
            only_studies: false,
            behind_proxy: false,
            folder: PathBuf::new(),
            rooms: 1,
            mind_rooms: 1,
            open: true,
            rounds: 1,
            game: GameSettings::default(),
            seed: 0,
        };
        let known = |settings: &ServerSettings, host: &'static str| {
            let headers = HeaderMap::from_iter([(header::HOST, HeaderValue::from_static(host))]);
            settings.is_known_host(&headers)
        };
        for host in ["localhost:8017", "127.0.0.1:8017", "[::1]:8017", "192.168.1.5"] {
            assert!(known(&settings(None), host), "{host}");
        }
        assert!(!known(&settings(None), "evil.example"));
        assert!(known(&settings(Some("lab.example")), "LAB.example"));
        assert!(!known(&settings(Some("lab.example")), "lab.example.evil.example"));
        assert!(!settings(None).is_known_host(&HeaderMap::new()));
    }
}
