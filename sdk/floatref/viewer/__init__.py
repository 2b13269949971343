"""One HTML file that shows profiles, or a recording, in a browser without a network."""

from floatref.viewer.profile_page import write_profile_page
from floatref.viewer.recording_page import write_recording_page

__all__ = ["write_profile_page", "write_recording_page"]
