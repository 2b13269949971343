"""The recording beside a profile: how a command is told of it, and the places that it has."""
