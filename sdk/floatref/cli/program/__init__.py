"""How both programs start, and how Ctrl-C ends them."""
