# No form of the note needs another one.
