"""The recording beside a profile: options that name it, and the places that it has."""
