"""The edition as a book: the documents and the data that the site shows, set by Typst as PDF/A."""
