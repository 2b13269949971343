"""What is to be processed: files found, listed and named."""
