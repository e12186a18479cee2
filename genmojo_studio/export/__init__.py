"""Taking scenes away: files, pictures and films, made by a second process with progress and cancel."""
