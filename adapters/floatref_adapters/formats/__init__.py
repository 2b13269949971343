"""A room for each format: recordings that come in, profiles that go out."""
