"""The worksheet of a certification: contents, files, page, terminal and pictures."""
